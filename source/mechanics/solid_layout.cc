#include <nmm/mechanics/solid_layout.h>

#include <algorithm>
#include <utility>

namespace NMM
{
  SolidLayout::SolidLayout(const FiniteElasticity                  &elasticity,
                           std::shared_ptr<const ForceTerm::Matrix> mass_in)
    : covers(&elasticity.cover_system())
    , mass(std::move(mass_in))
    , positions(covers->locally_owned_dofs(2), covers->communicator())
    , layout({covers->communicator(),
              covers->locally_owned_dofs(2),
              covers->locally_relevant_dofs(2),
              &elasticity.affine_constraints(),
              &positions,
              mass.get(),
              covers->manifold_mesh().physical_mesh().n_blocks(),
              {},
              {}})
  {
    for (const auto k : covers->locally_owned_covers())
      for (unsigned int c = 0; c < 2; ++c)
        positions(unknown_of(k, c)) = covers->node(k)[c];
    positions.compress(dealii::VectorOperation::insert);
    layout.absent_unknowns.set_size(positions.size());
    set_blocks();
  }


  void
  SolidLayout::set_blocks()
  {
    const ManifoldMesh &mesh = covers->manifold_mesh();
    if (layout.n_blocks < 2 ||
        dealii::Utilities::MPI::n_mpi_processes(layout.communicator) > 1)
      return;
    std::vector<unsigned int> &block_of = layout.blocks_of_unknowns;
    block_of.resize(2 * covers->n_covers());
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      for (const unsigned int k : covers->covers(e))
        block_of[unknown_of(k, 0)] = block_of[unknown_of(k, 1)] = mesh.block(e);
  }


  void
  SolidLayout::set_absent_blocks(const std::vector<bool> &is_absent)
  {
    const ManifoldMesh                          &mesh = covers->manifold_mesh();
    std::vector<dealii::types::global_dof_index> of_absent;
    if (!is_absent.empty())
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        if (is_absent[mesh.block(e)])
          for (const unsigned int k : covers->covers(e))
            if (covers->locally_owned_covers().is_element(k))
              of_absent.insert(of_absent.end(),
                               {unknown_of(k, 0), unknown_of(k, 1)});
    std::sort(of_absent.begin(), of_absent.end());
    of_absent.erase(std::unique(of_absent.begin(), of_absent.end()),
                    of_absent.end());
    dealii::IndexSet &absent = layout.absent_unknowns;
    absent.clear();
    absent.set_size(positions.size());
    absent.add_indices(of_absent.begin(), of_absent.end());
    absent.compress();
  }
} // namespace NMM
