#ifndef nmm_source_mechanics_finite_elasticity_data_h
#define nmm_source_mechanics_finite_elasticity_data_h

#include <nmm/mechanics/finite_elasticity.h>

#include <array>
#include <mechanics/conserving_terms.h>
#include <mechanics/reference_tables.h>
#include <vector>

namespace NMM
{
  /// The linear system and its assembly (finite_elasticity_assembly.cc).
  struct FiniteElasticity::Data : internal::ReferenceTables
  {
    using LocalDisplacement = internal::LocalDisplacement;
    using LocalSystem       = internal::LocalSystem;
    using EdgeTables        = internal::EdgeTables;

    Data(const CoverSystem                       &covers,
         const QuadratureCollection              &quadrature,
         const dealii::AffineConstraints<double> &constraints,
         const ElasticityProblem                 &problem,
         bool                                     may_float);

    /// Arguments of one assembly.
    struct Task
    {
      double  load_factor;
      Tangent tangent;
      bool    with_tangent, has_increment;
      /// Whether forces are those between two states, see assemble_between(), which also explains
      /// the following members.
      bool                  is_between = false;
      const LoadAmplitudes *first = nullptr, *last = nullptr;
      double                damping = 0.;
    };

    /// The factor of a load: amplitude of its boundary condition times the load factor [-].
    double
    condition_factor(const unsigned int condition, const Task &task) const
    {
      return task.load_factor * (amplitudes.boundary_conditions.empty()
                                   ? 1.
                                   : amplitudes.boundary_conditions[condition]);
    }

    /// Factors of prescribed displacements at the beginning and at the end of a
    /// step [-]; outside of assemble_between() both are the same.
    std::array<double, 2>
    factors(std::vector<double> LoadAmplitudes::*list,
            const unsigned int                   index,
            const Task                          &task) const
    {
      const auto at = [&](const LoadAmplitudes *given) {
        const std::vector<double> &values =
          (given == nullptr ? amplitudes : *given).*list;
        return task.load_factor * (values.empty() ? 1. : values[index]);
      };
      return {{at(task.first), at(task.last)}};
    }

    double
    forces_at_small_strain() const;

    Deformation
    add_elements(const Task &task);

    Deformation
    add_volume(unsigned int             element,
               const Task              &task,
               const LocalDisplacement &u,
               LocalSystem             &local,
               Energies                &sums) const;

    /// Assemble all terms at the displacements in `nodal`.
    Deformation
    assemble(const Task &task);

    Deformation
    add_weak_points(const EdgeTables::Site  &site,
                    const Task              &task,
                    const LocalDisplacement &u,
                    LocalSystem             &local);

    void
    add_follower_points(const EdgeTables::Site  &site,
                        const Task              &task,
                        const LocalDisplacement &u,
                        LocalSystem             &local);

    void
    add_fixed_points(unsigned int             element,
                     const Task              &task,
                     const LocalDisplacement &u,
                     LocalSystem             &local);

    Deformation
    add_ties(const Task &task);

    void
    add_dead_loads(const Task &task);

    /// @name Small displacements (linearized_energies.cc)
    /// @{

    /// Stress and moduli of the law of each region in the undeformed state.
    std::vector<HyperelasticLaw::Response>
    laws_at_rest() const;

    /// Add the internal forces of an element at the displacements in `nodal` to local.rhs. Returns
    /// its strain energy [J/m].
    double
    add_linearized_volume(unsigned int                     element,
                          const HyperelasticLaw::Response &at_rest,
                          LocalSystem                     &local) const;

    /// Add the forces of displacement conditions or ties at a site to local.rhs, except for those
    /// that vanish with the jump d. Returns their energy [J/m].
    double
    add_linearized_weak_points(
      const EdgeTables::Site                       &site,
      const std::vector<HyperelasticLaw::Response> &at_rest,
      LocalSystem                                  &local) const;

    /// Energy of this rank's conditions, ties and fixed points [J/m]. The squares of their forces
    /// are added to @p square.
    double
    add_linearized_conditions(double &square) const;
    /// @}

    bool
    is_absent(const unsigned int element) const
    {
      return !absent_blocks.empty() &&
             absent_blocks[covers->manifold_mesh().block(element)];
    }

    /// Whether the element belongs to an active block.
    bool
    is_active(const unsigned int element) const
    {
      return active_blocks.empty() ||
             active_blocks[covers->manifold_mesh().block(element)];
    }

    void
    set_active_blocks(const std::vector<bool> &blocks);

    /// Read the displacements that are needed for active blocks from a vector.
    void
    read(const Vector &u, std::vector<dealii::Tensor<1, 2>> &to) const;

    /// Add the squares of the changes of the local forces since the last call to the force scale.
    void
    gauge(const LocalSystem &local, double *known)
    {
      for (unsigned int i = 0; i < 2 * n_per_cell; ++i)
      {
        const double change = local.rhs[i] - known[i];
        force_square += change * change;
        known[i] = local.rhs[i];
      }
    }

    void
    add_local(dealii::ArrayView<const unsigned int> covers,
              const Task                           &task,
              const LocalSystem                    &local)
    {
      assembler.add(covers,
                    task.with_tangent ? local.matrix : nullptr,
                    local.rhs);
    }

    bool                                 is_inelastic = false;
    internal::RegionLaws                 region_to_law;
    std::vector<internal::ConservingLaw> region_to_conserving_law;
    LoadAmplitudes                       amplitudes;
    /// For each block whether it is absent, for each cover whether it belongs to an absent block,
    /// and for each block whether it is active. Empty: no block is absent, all are active.
    std::vector<bool> absent_blocks, absent_covers, active_blocks;
    unsigned int      n_assembled = 0;
    /// Elements, covers, and entries of each dead load that belong to active blocks.
    internal::ActiveItems              active_elements, active_covers;
    std::vector<internal::ActiveItems> active_loads;

    /// For each weak point, the factor of its penalty [-]; see adapt_penalties().
    std::vector<double>               penalty_growth;
    std::vector<dealii::Tensor<1, 2>> nodal, nodal_increment, nodal_begin,
      nodal_end;

    dealii::TrilinosWrappers::SparseMatrix matrix;
    Vector                                 residual;
    Energies                               energies;
    double                                 force_square      = 0.;
    double                                 force_scale       = 0.;
    double                                 least_force_scale = 0.;
    double                                 largest_jump      = 0.;
  };
} // namespace NMM

#endif
