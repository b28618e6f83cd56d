#ifndef nmm_source_mechanics_finite_elasticity_h
#define nmm_source_mechanics_finite_elasticity_h

#include <nmm/mechanics/finite_elasticity.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <linear_algebra/cover_matrix_assembler.h>
#include <mechanics/conserving_terms.h>
#include <mechanics/curve_conditions.h>
#include <mechanics/edge_tables.h>
#include <mechanics/element_tables.h>
#include <mechanics/ghost_terms.h>
#include <mechanics/initial_stress_terms.h>
#include <mechanics/linear_terms.h>
#include <mechanics/point_terms.h>
#include <memory>
#include <optional>
#include <vector>

namespace NMM
{
  /// Tables that are computed once in the reference configuration, the linear system and its
  /// assembly (finite_elasticity_assembly.cc).
  struct FiniteElasticity::Data
  {
    using LocalDisplacement = internal::LocalDisplacement;
    using LocalSystem       = internal::LocalSystem;
    using EdgeTables        = internal::EdgeTables;

    Data(const CoverSystem                       &covers,
         const QuadratureCollection              &quadrature,
         const dealii::AffineConstraints<double> &constraints,
         const ElasticityProblem                 &problem,
         bool                                     may_float,
         const GhostPenalty                      *ghost_penalty);

    /// The forces that are assembled.
    enum class Forces
    {
      /// Those of assemble().
      finite,
      /// Those of assemble_between().
      between,
      /// Those of assemble_linearized().
      linearized,
      /// Those of assemble_at_rest().
      at_rest
    };

    /// Arguments of one assembly.
    struct Task
    {
      double  load_factor;
      Tangent tangent;
      bool    has_increment = false;
      Forces  forces        = Forces::finite;
      /// See assemble_between().
      const LoadAmplitudes *first = nullptr, *last = nullptr;
      double                damping = 0.;

      bool
      with_tangent() const
      {
        return tangent != Tangent::none;
      }
    };

    /// The covers of both elements of a tie.
    std::array<unsigned int, LocalSystem::max_covers>
    covers_of_tie(const EdgeTables::Site &tie) const
    {
      return internal::covers_of_pair(*covers, tie.element, tie.neighbor);
    }

    /// Read the displacements of the covers of a site's element, then those of its neighbor.
    void
    gather(const EdgeTables::Site                  &site,
           const std::vector<dealii::Tensor<1, 2>> &from,
           LocalDisplacement                       &u) const
    {
      u.gather(covers->covers(site.element), from);
      if (site.neighbor != invalid_index)
        u.gather(covers->covers(site.neighbor), from, n_per_cell);
    }

    /// Call action(i) for the points of a site of conditions or ties that have not been released.
    template <typename Action>
    void
    for_each_weak_point(const EdgeTables::Site &site,
                        const Action           &action) const
    {
      const std::vector<bool> &released = amplitudes.released_conditions;
      for (unsigned int q = site.first_point; q < site.last_point; ++q)
      {
        const unsigned int condition = edges->weak_points[q].condition;
        if (condition == invalid_index || released.empty() ||
            !released[condition])
          action(q);
      }
    }

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
               LocalSystem             &local) const;

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
    add_ghost_terms(const Task &task);

    void
    add_dead_loads(const Task &task);

    /// Make the tables of elements unless they are there; forces at rest do not need them.
    void
    make_tables() const
    {
      if (!tables)
        tables.emplace(*covers, *quadrature);
    }

    bool
    is_absent(const unsigned int element) const
    {
      return !absent_blocks.empty() &&
             absent_blocks[covers->manifold_mesh().block(element)];
    }

    /// Whether the element belongs to a chosen block.
    bool
    is_chosen(const unsigned int element) const
    {
      return chosen_blocks.empty() ||
             chosen_blocks[covers->manifold_mesh().block(element)];
    }

    void
    restrict_to(const BlockSelection &blocks);

    /// Read the displacements that are needed for chosen blocks from a vector.
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

    /// Take note of the jump @p d at a point.
    void
    gauge_jump(const internal::WeakPoint &point, const dealii::Tensor<1, 2> &d)
    {
      // the trace constant of an element without area is infinite
      const double jump = d.norm() * point.trace_constant;
      if (std::isfinite(jump))
        largest_jump = std::max(largest_jump, jump);
    }

    /// Add the terms of the covers @p to to the system.
    void
    add_local(const Task                                  &task,
              const dealii::ArrayView<const unsigned int> &to,
              LocalSystem                                 &local);

    const CoverSystem                             *covers;
    const QuadratureCollection                    *quadrature;
    const dealii::AffineConstraints<double>       *constraints;
    const ElasticityProblem                       *problem;
    unsigned int                                   n_per_cell;
    internal::CurveConditions                      curve_conditions;
    internal::PointTerms                           points;
    internal::LinearTerms                          linear_terms;
    mutable std::optional<internal::ElementTables> tables;
    std::unique_ptr<EdgeTables>                    edges;
    /// Null if no initial stress varies.
    std::unique_ptr<internal::InitialStressTerms> initial_stress;
    internal::DeadLoads                           dead_loads;
    internal::CoverMatrixAssembler                assembler;

    bool                                 is_inelastic = false;
    internal::RegionLaws                 region_to_law;
    std::vector<internal::ConservingLaw> region_to_conserving_law;
    LoadAmplitudes                       amplitudes;
    /// For each block whether it is absent, for each cover whether it belongs to an absent block,
    /// and for each block whether it is chosen. Empty: no block is absent, all are chosen.
    std::vector<bool> absent_blocks, absent_covers, chosen_blocks;
    unsigned int      n_assembled = 0;
    /// Elements, covers, and entries of each dead load that belong to chosen blocks.
    internal::ChosenItems              chosen_elements, chosen_covers;
    std::vector<internal::ChosenItems> chosen_loads;

    bool                                               has_ghost_penalty;
    std::vector<std::pair<unsigned int, unsigned int>> ghost_pairs;
    /// The inhomogeneities of the constraints as displacements of covers [m]; empty if all are 0.
    std::vector<dealii::Tensor<1, 2>> inhomogeneities;

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
