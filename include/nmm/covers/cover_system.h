#ifndef nmm_covers_cover_system_h
#define nmm_covers_cover_system_h

#include <nmm/covers/manifold_mesh.h>
#include <nmm/covers/unknowns.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/types.h>

#include <vector>

namespace NMM
{
  /**
   * Physical covers and their unknowns. A manifold mesh comes in; covers and unknowns of each
   * element and the index sets of this rank go out.
   *
   * A physical cover is a connected component, per mathematical cover, of the
   * manifold elements in its support, joined across shared mathematical edges
   * where no physical curve separates them. The map
   * (element, local weight function) -> physical cover replaces deal.II's cell
   * dof indices; nothing is copied.
   *
   * Numbering: by owner rank, then by first appearance along the element
   * numbering, which keeps the bandwidth small. Unknown of component c of cover
   * k: n_components * k + c.
   *
   * Every rank knows all covers. Ownership: ranks own consecutive ranges of the element numbering of
   * about equal length, which contain all elements of a cell or none. A cover belongs to the lowest
   * rank among its elements.
   *
   * Lifetime: the manifold mesh must outlive this object.
   */
  class CoverSystem
  {
  public:
    /// Find the covers of @p manifold_mesh and number them, and divide them among the ranks of
    /// @p communicator. Not collective.
    CoverSystem(const ManifoldMesh &manifold_mesh, MPI_Comm communicator);

    /// The manifold mesh of the constructor.
    const ManifoldMesh &
    manifold_mesh() const;

    /// The communicator of the constructor, over which unknowns are distributed.
    MPI_Comm
    communicator() const;

    /// Number of covers.
    unsigned int
    n_covers() const;

    /// Physical covers of an element, in the order of the finite element's dofs.
    dealii::ArrayView<const unsigned int>
    covers(unsigned int element) const;

    /// Get the unknowns of an element with @p n_components unknowns per cover: entry
    /// n_components * i + c belongs to weight function i, component c.
    void
    get_dof_indices(
      unsigned int                                  element,
      unsigned int                                  n_components,
      std::vector<dealii::types::global_dof_index> &indices) const;

    /// Mathematical cover that a physical cover is a piece of.
    unsigned int
    mathematical_cover(unsigned int cover) const;

    /// Node of the cover's weight function [m]; it may lie outside the solid.
    const dealii::Point<2> &
    node(unsigned int cover) const;

    /// Elements that this rank integrates, first and past-the-end.
    std::pair<unsigned int, unsigned int>
    locally_owned_elements() const;

    /// Covers that this rank owns.
    const dealii::IndexSet &
    locally_owned_covers() const;

    /// Covers whose values this rank needs; they include the owned ones.
    const dealii::IndexSet &
    locally_relevant_covers() const;

    /// Unknowns of the owned covers, @p n_components for each.
    dealii::IndexSet
    locally_owned_dofs(unsigned int n_components) const;

    /// Unknowns of the relevant covers, @p n_components for each.
    dealii::IndexSet
    locally_relevant_dofs(unsigned int n_components) const;

    /// Add @p covers to the relevant covers of this rank. Vectors that exist already keep their
    /// layout.
    void
    make_relevant(std::vector<dealii::types::global_dof_index> covers);

    /// The same for the covers of all elements at a curve, which contact needs on all ranks.
    void
    make_boundary_relevant();

  private:
    /// Number of layers of elements around the owned ones whose covers are relevant; the
    /// recovery of stresses needs them.
    static constexpr unsigned int halo_width = 6;

    void
    number_covers();

    void
    distribute();

    void
    add_relevant_elements(unsigned int n_layers);

    const ManifoldMesh                   *mesh;
    MPI_Comm                              mpi_communicator;
    unsigned int                          n_per_element;
    std::vector<unsigned int>             element_to_covers;
    std::vector<unsigned int>             cover_to_mathematical;
    std::pair<unsigned int, unsigned int> owned_elements;
    dealii::IndexSet                      owned_covers, relevant_covers;
  };
} // namespace NMM

#endif
