#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <atomic>
#include <base/in_order.h>
#include <cmath>
#include <mechanics/finite_elasticity.h>
#include <mechanics/floating_blocks.h>
#include <mechanics/nodal_values.h>
#include <mechanics/trace_constant.h>

// Assembly of elements, displacement conditions, ties and loads.
namespace NMM
{
  using namespace internal;

  namespace
  {
    /// The mesh of @p covers, once it is known to be fit for @p problem.
    const ManifoldMesh &
    checked_mesh(const CoverSystem &covers, const ElasticityProblem &problem)
    {
      const ManifoldMesh &mesh = covers.manifold_mesh();
      problem.check(mesh.physical_mesh());
      return mesh;
    }


    /// The mean of two displacements of @p n covers.
    LocalDisplacement
    mean(const LocalDisplacement &a,
         const LocalDisplacement &b,
         const unsigned int       n)
    {
      LocalDisplacement result;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          result.values[i][c] = 0.5 * (a.values[i][c] + b.values[i][c]);
      return result;
    }
  } // namespace


  FiniteElasticity::Data::Data(
    const CoverSystem                       &covers,
    const QuadratureCollection              &quadrature,
    const dealii::AffineConstraints<double> &constraints,
    const ElasticityProblem                 &problem,
    const bool                               may_float,
    const GhostPenalty                      *ghost_penalty)
    : covers(&covers)
    , quadrature(&quadrature)
    , constraints(&constraints)
    , problem(&problem)
    , n_per_cell(covers.manifold_mesh().mathematical_mesh().n_covers_per_cell())
    , curve_conditions(checked_mesh(covers, problem), problem)
    , points(covers, problem)
    , linear_terms(covers, quadrature, problem)
    , dead_loads(covers, quadrature, problem, curve_conditions, points)
    , assembler(covers, constraints)
    , has_ghost_penalty(ghost_penalty != nullptr)
    , ghost_pairs(owned_pairs(covers, ghost_penalty))
  {
    if (!may_float)
      check_no_block_floats(covers, problem, curve_conditions, points);
    TraceConstants trace_constants(
      covers, quadrature, constraints, curve_conditions, ghost_penalty);
    edges = std::make_unique<EdgeTables>(covers,
                                         problem,
                                         curve_conditions,
                                         trace_constants);
    if (problem.has_varying_initial_stress())
      initial_stress = std::make_unique<InitialStressTerms>(covers,
                                                            quadrature,
                                                            problem,
                                                            *edges);
    for (const EdgeTables::Site &tie : edges->ties)
      assembler.couple({covers_of_tie(tie).data(), 2 * n_per_cell});
    for (const auto &[first, second] : ghost_pairs)
      assembler.couple(
        {covers_of_pair(covers, first, second).data(), 2 * n_per_cell});
    assembler.ignore_inhomogeneities();
    for (const unsigned int m :
         problem.region_to_material(covers.manifold_mesh().physical_mesh()))
    {
      Material material = problem.materials[m];
      if (material.inelastic_law(problem.plane_state) != nullptr)
      {
        is_inelastic            = true;
        material.law            = default_material_law();
        material.initial_stress = 0.;
      }
      region_to_law.push_back(material.hyperelastic_law(problem.plane_state));
      region_to_conserving_law.emplace_back(region_to_law.back(),
                                            material.initial_stress);
    }
    penalty_growth.assign(edges->weak_points.size(), 1.);
    assembler.restrict_to(chosen_covers);
    assembler.build(matrix, residual);
    least_force_scale = forces_at_small_strain();
  }


  /// The root of the sum of squares of internal forces at a strain of 1e-6. Relative to these
  /// forces, the rounding errors in F = I + grad u are below tolerances, however small the load is.
  double
  FiniteElasticity::Data::forces_at_small_strain() const
  {
    constexpr double    strain = 1e-6;
    const ManifoldMesh &mesh   = covers->manifold_mesh();
    double              square = 0.;
    const auto [first, last]   = covers->locally_owned_elements();
    for (unsigned int e = first; e < last; ++e)
    {
      const double stress =
        strain *
        region_to_law[mesh.region(e)]->small_strain().largest_eigenvalue();
      square += stress * stress * mesh.area(e);
    }
    return std::sqrt(
      dealii::Utilities::MPI::sum(square, covers->communicator()));
  }


  void
  FiniteElasticity::Data::restrict_to(const BlockSelection &blocks)
  {
    chosen_blocks = blocks;
    if (!blocks.empty() && chosen_elements.empty())
    {
      const ManifoldMesh       &mesh = covers->manifold_mesh();
      std::vector<unsigned int> element_to_block(mesh.n_elements()),
        cover_to_block(covers->n_covers());
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        element_to_block[e] = mesh.block(e);
        for (const unsigned int k : covers->covers(e))
          cover_to_block[k] = mesh.block(e);
      }
      chosen_elements.reinit(element_to_block);
      chosen_covers.reinit(cover_to_block);
      dead_loads.for_each_load([&](const DeadLoads::Load &load) {
        chosen_loads.emplace_back();
        chosen_loads.back().reinit(load.covers.size(), [&](const auto &add) {
          for (unsigned int i = 0; i < load.covers.size(); ++i)
            add(i, cover_to_block[load.covers[i]]);
        });
      });
    }
    chosen_elements.select(blocks);
    chosen_covers.select(blocks);
    for (internal::ChosenItems &load : chosen_loads)
      load.select(blocks);
  }


  void
  FiniteElasticity::Data::read(const Vector                      &u,
                               std::vector<dealii::Tensor<1, 2>> &to) const
  {
    // ties also need the displacements of blocks next to chosen ones
    if (!edges->ties.empty())
      read_nodal_values(*covers, u, to);
    else
      read_nodal_values(*covers, u, chosen_covers, to);
  }


  Deformation
  FiniteElasticity::Data::add_weak_points(const EdgeTables::Site  &site,
                                          const Task              &task,
                                          const LocalDisplacement &u,
                                          LocalSystem             &local)
  {
    LocalDisplacement begin, end;
    if (task.forces == Forces::between)
    {
      gather(site, nodal_begin, begin);
      gather(site, nodal_end, end);
    }
    Deformation state = Deformation::admissible;
    for_each_weak_point(site, [&](const unsigned int q) {
      if (state != Deformation::admissible)
        return;
      const WeakPoint      &point  = edges->weak_points[q];
      std::array<double, 2> factor = {};
      if (point.condition != invalid_index)
        factor =
          factors(&LoadAmplitudes::boundary_conditions, point.condition, task);
      NitscheTerms terms(point, n_per_cell, penalty_growth[q] * point.penalty);
      if (task.forces == Forces::between)
      {
        const std::array<dealii::Tensor<1, 2>, 2> d = {
          {terms.jump(begin, factor[0]), terms.jump(end, factor[1])}};
        state = conserving_fluxes(
          region_to_conserving_law, begin, end, d, task.tangent, terms);
        if (initial_stress)
          initial_stress->add_finite_fluxes(
            q, mean(begin, end, point.n_sides * n_per_cell), terms);
        gauge_jump(point, d[1]);
        energies.work_of_conditions -= point.weight * (factor[1] - factor[0]) *
                                       (terms.force() * point.prescribed);
      }
      else
      {
        terms.d = terms.jump(u, factor[0]);
        if (task.forces == Forces::finite)
        {
          state = elastic_fluxes(region_to_law, u, task.tangent, terms);
          if (initial_stress)
            initial_stress->add_finite_fluxes(q, u, terms);
        }
        else
        {
          set_linear_fluxes(linear_terms.laws(), u, terms);
          if (initial_stress)
            initial_stress->add_small_fluxes(q, terms);
        }
        gauge_jump(point, terms.d);
      }
      if (state == Deformation::admissible)
        terms.add(local);
    });
    return state;
  }


  void
  FiniteElasticity::Data::add_fixed_points(const unsigned int       element,
                                           const Task              &task,
                                           const LocalDisplacement &u,
                                           LocalSystem             &local)
  {
    for (unsigned int f = 0; f < problem->fixed_points.size(); ++f)
      if (points.fixed_point_elements()[f] == element &&
          (amplitudes.released_fixed_points.empty() ||
           !amplitudes.released_fixed_points[f]))
      {
        const auto [first, last] =
          factors(&LoadAmplitudes::fixed_points, f, task);
        points.add_spring(f, 0.5 * (first + last), u, local);
        if (first != last)
        {
          // the energy is quadratic in the factor, so that this difference is exactly its
          // derivative at the mean factor times the change
          LocalSystem states[2];
          for (unsigned int i = 0; i < 2; ++i)
          {
            states[i].reset(n_per_cell, /* needs_matrix = */ false);
            points.add_spring(f, i == 0 ? first : last, u, states[i]);
          }
          energies.work_of_conditions += states[1].energy - states[0].energy;
        }
      }
  }


  void
  FiniteElasticity::Data::add_follower_points(const EdgeTables::Site  &site,
                                              const Task              &task,
                                              const LocalDisplacement &u,
                                              LocalSystem             &local)
  {
    // in small displacements pressure keeps its direction
    const bool is_dead =
      task.forces == Forces::linearized || task.forces == Forces::at_rest;
    const bool with_matrix = local.with_matrix;
    local.with_matrix      = with_matrix && !is_dead;
    for (unsigned int q = site.first_point; q < site.last_point; ++q)
    {
      const EdgeTables::FollowerPoint &point = edges->follower_points[q];
      add_follower_point(point,
                         condition_factor(point.condition, task),
                         is_dead ? LocalDisplacement() : u,
                         local);
    }
    local.with_matrix = with_matrix;
  }


  Deformation
  FiniteElasticity::Data::add_volume(const unsigned int       element,
                                     const Task              &task,
                                     const LocalDisplacement &u,
                                     LocalSystem             &local) const
  {
    const auto         element_covers = covers->covers(element);
    const unsigned int region         = covers->manifold_mesh().region(element);
    LocalDisplacement  first, second;
    if (task.forces == Forces::at_rest)
    {
      linear_terms.add_at_rest(element, local);
      if (initial_stress)
        initial_stress->add_small(element, LocalDisplacement(), local);
      return Deformation::admissible;
    }
    const ElementTables::View table = (*tables)(element);
    if (task.forces == Forces::linearized)
    {
      linear_terms.add_forces(element, table, u, local);
      if (initial_stress)
        initial_stress->add_small(element, u, local);
      return Deformation::admissible;
    }
    if (task.forces == Forces::between)
    {
      first.gather(element_covers, nodal_begin);
      second.gather(element_covers, nodal_end);
      const Deformation state =
        add_conserving_terms(region_to_conserving_law[region],
                             table,
                             first,
                             second,
                             task.damping,
                             local);
      if (initial_stress)
        initial_stress->add_finite(element,
                                   mean(first, second, n_per_cell),
                                   local);
      return state;
    }
    if (task.has_increment)
      first.gather(element_covers, nodal_increment);
    const Deformation state =
      add_volume_terms(*region_to_law[region],
                       table,
                       u,
                       task.has_increment ? &first : nullptr,
                       local);
    if (initial_stress)
      initial_stress->add_finite(element, u, local);
    return state;
  }


  Deformation
  FiniteElasticity::Data::add_elements(const Task &task)
  {
    /// Terms of the volume of an element, which threads compute in parallel.
    struct Volume
    {
      LocalSystem       local;
      LocalDisplacement u;
      Deformation       state;
    };

    double      known[2 * LocalSystem::max_covers];
    auto        condition    = edges->conditions.begin();
    auto        follower     = edges->followers.begin();
    Deformation state        = Deformation::admissible;
    const auto [first, last] = covers->locally_owned_elements();
    if (task.forces != Forces::at_rest)
      make_tables();
    // lets threads skip the remaining elements once one is inverted
    std::atomic<bool> is_inverted(false);
    n_assembled           = 0;
    const bool is_all     = chosen_elements.all();
    const auto element_of = [&](const unsigned int i) {
      return is_all ? i : chosen_elements.chosen()[i];
    };
    const auto go_to = [](auto &site, const auto &end, const unsigned int e) {
      while (site != end && site->element < e)
        ++site;
      return site != end && site->element == e;
    };
    for_each_in_order<Volume>(
      is_all ? first : 0,
      is_all ? last : chosen_elements.chosen().size(),
      [&](const unsigned int i, Volume &volume) {
        const unsigned int e = element_of(i);
        if (is_absent(e) || is_inverted)
          return;
        volume.u.gather(covers->covers(e), nodal);
        volume.local.reset(n_per_cell, task.with_tangent());
        volume.state = add_volume(e, task, volume.u, volume.local);
      },
      [&](const unsigned int i, Volume &volume) {
        const unsigned int e     = element_of(i);
        const bool has_condition = go_to(condition, edges->conditions.end(), e);
        const bool has_follower  = go_to(follower, edges->followers.end(), e);
        if (!is_absent(e) && state == Deformation::admissible)
        {
          ++n_assembled;
          energies.strain += volume.local.energy;
          energies.dissipated += volume.local.dissipated;
          volume.local.energy = 0.;
          state               = volume.state;
          std::fill_n(known, 2 * n_per_cell, 0.);
          gauge(volume.local, known);
          if (state == Deformation::admissible && has_condition)
            state = add_weak_points(*condition, task, volume.u, volume.local);
          is_inverted = state == Deformation::inverted;
          gauge(volume.local, known);
          if (has_follower)
            add_follower_points(*follower, task, volume.u, volume.local);
          if (!problem->fixed_points.empty())
            add_fixed_points(e, task, volume.u, volume.local);
          gauge(volume.local, known);
          energies.conditions += volume.local.energy;
          add_local(task, covers->covers(e), volume.local);
        }
      });
    return state;
  }


  Deformation
  FiniteElasticity::Data::add_ties(const Task &task)
  {
    LocalSystem       local;
    LocalDisplacement u;
    for (const EdgeTables::Site &tie : edges->ties)
    {
      if (is_absent(tie.element) || is_absent(tie.neighbor) ||
          !(is_chosen(tie.element) || is_chosen(tie.neighbor)))
        continue;
      gather(tie, nodal, u);
      local.reset(2 * n_per_cell, task.with_tangent());
      if (add_weak_points(tie, task, u, local) != Deformation::admissible)
        return Deformation::inverted;
      energies.conditions += local.energy;
      add_local(task, {covers_of_tie(tie).data(), 2 * n_per_cell}, local);
    }
    return Deformation::admissible;
  }


  void
  FiniteElasticity::Data::add_ghost_terms(const Task &task)
  {
    if (ghost_pairs.empty())
      return;
    const GhostTerms ghost_terms(*covers, *problem);
    LocalSystem      local;
    for (const auto &pair : ghost_pairs)
    {
      local.reset(2 * n_per_cell);
      ghost_terms.add_stiffness(pair, local);
      add_local(task,
                {covers_of_pair(*covers, pair.first, pair.second).data(),
                 2 * n_per_cell},
                local);
    }
  }


  void
  FiniteElasticity::Data::add_local(
    const Task                                  &task,
    const dealii::ArrayView<const unsigned int> &to,
    LocalSystem                                 &local)
  {
    // the terms at rest are those of u = 0
    if (task.forces == Forces::at_rest && !inhomogeneities.empty())
    {
      LocalDisplacement u;
      u.gather(to, inhomogeneities);
      const unsigned int n = 2 * local.n_covers;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          local.rhs[i] +=
            local.matrix[n * i + j] * u.values[cover_of(j)][component_of(j)];
    }
    assembler.add(to, local.with_matrix ? local.matrix : nullptr, local.rhs);
  }


  void
  FiniteElasticity::Data::add_dead_loads(const Task &task)
  {
    double       square = 0., work = 0.;
    unsigned int n   = 0;
    const auto   add = [&](const DeadLoads::Load &load, const double factor) {
      const auto add_entry = [&](const unsigned int i) {
        const unsigned int k = load.covers[i];
        if (!absent_covers.empty() && absent_covers[k])
          return;
        const dealii::Tensor<1, 2> f = -factor * load.forces[i];
        assembler.add({&k, 1}, nullptr, &f[0]);
        square += f.norm_square();
        work += f * nodal[k];
      };
      if (chosen_elements.all())
        for (unsigned int i = 0; i < load.covers.size(); ++i)
          add_entry(i);
      else
        for (const unsigned int i : chosen_loads[n].chosen())
          add_entry(i);
      ++n;
    };
    for (unsigned int c = 0; c < dead_loads.boundary_conditions.size(); ++c)
      add(dead_loads.boundary_conditions[c], condition_factor(c, task));
    for (unsigned int f = 0; f < dead_loads.point_forces.size(); ++f)
      add(dead_loads.point_forces[f],
          task.load_factor * (amplitudes.point_forces.empty()
                                ? 1.
                                : amplitudes.point_forces[f]));
    add(dead_loads.gravity, task.load_factor * amplitudes.gravity);
    add(dead_loads.body_force, task.load_factor * amplitudes.body_force);
    energies.loads = work;
    force_square += square;
  }


  Deformation
  FiniteElasticity::Data::assemble(const Task &task)
  {
    AssertThrow(task.forces == Forces::at_rest || !has_ghost_penalty,
                InputError("a ghost penalty is for linear problems only",
                           "these equations",
                           "aggregate covers instead"));
    assembler.reset(task.with_tangent());
    energies          = Energies();
    force_square      = 0.;
    largest_jump      = 0.;
    Deformation state = add_elements(task);
    if (state == Deformation::admissible)
      state = add_ties(task);
    if (task.forces == Forces::at_rest)
      add_ghost_terms(task);
    add_dead_loads(task);
    assembler.compress(task.with_tangent());

    // if an element is inverted on any rank, the result is inverted on all ranks
    double sums[7] = {state == Deformation::inverted ? 1. : 0.,
                      force_square,
                      energies.strain,
                      energies.conditions,
                      energies.loads,
                      energies.work_of_conditions,
                      energies.dissipated};
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums, 7),
                                covers->communicator(),
                                dealii::ArrayView<double>(sums, 7));
    if (sums[0] > 0.)
      return Deformation::inverted;
    force_scale         = std::hypot(std::sqrt(sums[1]), least_force_scale);
    energies.strain     = sums[2];
    energies.conditions = sums[3];
    energies.loads      = sums[4];
    energies.work_of_conditions = sums[5];
    energies.dissipated         = sums[6];
    largest_jump =
      dealii::Utilities::MPI::max(largest_jump, covers->communicator());
    return Deformation::admissible;
  }
} // namespace NMM
