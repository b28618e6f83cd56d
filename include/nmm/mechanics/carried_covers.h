#ifndef nmm_mechanics_carried_covers_h
#define nmm_mechanics_carried_covers_h

#include <nmm/covers/cover_system.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace NMM
{
  /**
   * Carries displacements, velocities and accelerations over to the covers of a solid that was
   * cut further, e.g. since a crack has grown.
   *
   * Each element after the cut is a part of one before it. If the mathematical mesh is the same,
   * each cover after the cut is a part of one cover before it, or all of it, and takes that one's
   * value: the function is the same on each element to the last bit, and there is no projection.
   * The parts of a cover that the cut divides get equal values. If cells were divided (bisected or
   * quartered), covers get the value that the function before the cut has at their nodes. This is
   * the same function where quadratic functions on the former cells are quadratic on the new
   * ones, and an interpolation with an error of order h^3 at those few cells where the
   * refinement ends. Where cells have become larger, as behind a crack tip from which a graded
   * mesh turns away, the value at the node comes from the nearest of the former elements at the
   * quadrature points. This extrapolates over a few former cells, which is good enough for the first
   * guess of an equilibrium; a motion needs cells that do not become larger.
   *
   * Functions that are carried over need not satisfy the constraints of covers that are aggregated
   * only after the cut; TimeIntegrator::continue_after_cut() sees to these.
   *
   * On several ranks each one looks at its own elements, and the best of all proposals is taken.
   *
   * Limits: both solids have the same curves but for those that the cut adds.
   * Source: derived here from the definition of covers, eq. (5).
   */
  class CarriedCovers
  {
  public:
    /// Vector of owned unknowns, two for each cover.
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /**
     * Find for each cover of @p to the element of @p from that its value comes from. @p rules are
     * rules on the elements of @p to that this rank owns, whose points locate these. Both cover
     * systems must outlive this object. Collective.
     * @throws NumericalFailure for a cover of which no element lies in the solid before the cut.
     */
    CarriedCovers(const CoverSystem          &from,
                  const CoverSystem          &to,
                  const QuadratureCollection &rules);

    /// The function @p values of the solid before the cut, as one of the solid after it. Collective.
    Vector
    carry(const Vector &values) const;

    /// The block (ManifoldMesh::block()) before the cut of which @p block after the cut is a part.
    unsigned int
    former_block(unsigned int block) const;

  private:
    /// The value of a cover: sum over i of weights[i] times the value of the i-th cover of the
    /// former element.
    struct Origin
    {
      unsigned int element    = invalid_index;
      double       weights[6] = {};
    };

    /// A former element from which a cover may take its value.
    struct Proposal
    {
      /// How far the node lies outside of the former cell, as a share of it; 0 inside.
      double outside = 0.;
      /// Area of the element after the cut [m^2]; negative if there is none.
      double area = -1.;
      Origin origin;

      /// Interpolation is better than extrapolation, and large elements are located best.
      bool
      is_better_than(const Proposal &other) const;

      /// For the exchange between ranks.
      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /* version */)
      {
        archive &outside &area &origin.element &origin.weights;
      }
    };

    const CoverSystem        *from, *to;
    std::vector<Origin>       origins;
    std::vector<unsigned int> former_blocks;

    /// Element before the cut that contains the element @p element after it; invalid_index if it
    /// is too small to be found.
    unsigned int
    find_former(unsigned int element, const dealii::Quadrature<2> &rule) const;

    /// The same for the point @p q of the element's rule.
    unsigned int
    find_former(unsigned int                 element,
                const dealii::Quadrature<2> &rule,
                unsigned int                 q) const;
  };
} // namespace NMM

#endif
