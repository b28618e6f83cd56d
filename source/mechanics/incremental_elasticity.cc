#include <nmm/base/exceptions.h>
#include <nmm/mechanics/incremental_elasticity.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>
#include <linear_algebra/direct_solver.h>
#include <mechanics/nodal_values.h>
#include <mechanics/reference_tables.h>

namespace NMM
{
  using namespace internal;
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  namespace
  {
    /// The stress R (sigma + C : sym h) R^T after a step with the displacement gradient h, where R
    /// is the rotation of I + h.
    SymmetricTensor<2, 2>
    updated_stress(const SymmetricTensor<2, 2> &stress,
                   const PlaneElasticity       &elasticity,
                   const Tensor<2, 2>          &h)
    {
      const SymmetricTensor<2, 2> s = stress + elasticity.stress(h);
      const double                angle =
        std::atan2(h[1][0] - h[0][1], 2. + h[0][0] + h[1][1]);
      Tensor<2, 2> R;
      R[0][0] = R[1][1] = std::cos(angle);
      R[1][0]           = std::sin(angle);
      R[0][1]           = -R[1][0];
      return dealii::symmetrize(R * Tensor<2, 2>(s) * dealii::transpose(R));
    }


    /// Compute gradients on the current geometry: those on the reference geometry times F^-1.
    void
    push_forward(const unsigned int  n,
                 const Tensor<2, 2> &inverse,
                 const double (*reference)[2],
                 double (*current)[2])
    {
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int d = 0; d < 2; ++d)
          current[i][d] =
            reference[i][0] * inverse[0][d] + reference[i][1] * inverse[1][d];
    }


    /// Gradient of the displacement sum_i v_i w_i.
    Tensor<2, 2>
    gradient(const unsigned int n,
             const double (*values)[2],
             const double (*gradients)[2])
    {
      Tensor<2, 2> h;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int d = 0; d < 2; ++d)
            h[c][d] += values[i][c] * gradients[i][d];
      return h;
    }
  } // namespace


  struct IncrementalElasticity::Data : ReferenceTables
  {
    Data(const CoverSystem                       &covers,
         const QuadratureCollection              &quadrature,
         const dealii::AffineConstraints<double> &constraints,
         const ElasticityProblem                 &problem,
         bool                                     may_float);

    /// Hooke's moduli [Pa],
    /// A_iJkL = lambda delta_iJ delta_kL + mu (delta_ik delta_JL + delta_iL delta_kJ),
    /// stored at [2i + J][2k + L].
    struct Moduli
    {
      double A[4][4];

      explicit Moduli(const PlaneElasticity &e)
        : A()
      {
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int J = 0; J < 2; ++J)
            for (unsigned int k = 0; k < 2; ++k)
              for (unsigned int L = 0; L < 2; ++L)
                A[2 * i + J][2 * k + L] = (i == J && k == L ? e.lambda : 0.) +
                                          (i == k && J == L ? e.mu : 0.) +
                                          (i == L && k == J ? e.mu : 0.);
      }
    };

    /// Current geometry at a weak point: gradients of each side [1/m], unit normal, and current
    /// length divided by reference length [-].
    struct CurrentPoint
    {
      double       gradients[2][WeightFunctions::max_per_cell][2];
      Tensor<1, 2> normal;
      double       length_ratio;
    };

    /// Compute the current geometry. Returns false if a side is turned inside out.
    bool
    locate(const WeakPoint         &point,
           const LocalDisplacement &u,
           CurrentPoint            &current) const;

    bool
    add_element(unsigned int             element,
                const LocalDisplacement &u,
                LocalSystem             &local) const;

    bool
    add_weak_points(const EdgeTables::Site  &site,
                    double                   load_factor,
                    const LocalDisplacement &u,
                    LocalSystem             &local) const;

    bool
    assemble(double load_factor);

    void
    update_weak_stress(const EdgeTables::Site  &site,
                       const LocalDisplacement &u,
                       const LocalDisplacement &increment);

    void
    update_stress();

    void
    add_work(double load_factor);

    std::vector<PlaneElasticity> region_to_elasticity;
    std::vector<Moduli>          region_to_moduli;
    DirectSolver                 direct_solver;

    /// Cauchy stress at each quadrature point of elements, and on both sides of each weak point
    /// [Pa].
    std::vector<SymmetricTensor<2, 2>> stress, weak_stress;
    std::vector<Tensor<1, 2>>          nodal, nodal_increment;

    dealii::TrilinosWrappers::SparseMatrix matrix;
    Vector residual, correction, owned, solution;
    double work_of_loads = 0.;
  };


  IncrementalElasticity::Data::Data(
    const CoverSystem                       &covers,
    const QuadratureCollection              &quadrature,
    const dealii::AffineConstraints<double> &constraints,
    const ElasticityProblem                 &problem,
    const bool                               may_float)
    : ReferenceTables(covers, quadrature, constraints, problem, may_float)
  {
    const ManifoldMesh &mesh = covers.manifold_mesh();
    const auto          region_to_material =
      problem.region_to_material(mesh.physical_mesh());
    for (const unsigned int m : region_to_material)
    {
      region_to_elasticity.push_back(
        problem.materials[m].plane_elasticity(problem.plane_state));
      region_to_moduli.emplace_back(region_to_elasticity.back());
    }
    assembler.build(matrix, residual);

    const auto [first, last] = covers.locally_owned_elements();
    stress.reserve(tables.n_points());
    for (unsigned int e = first; e < last; ++e)
      stress.insert(
        stress.end(),
        tables(e).n_points,
        problem.materials[region_to_material[mesh.region(e)]].initial_stress);
    for (const WeakPoint &point : edges->weak_points)
      for (unsigned int s = 0; s < 2; ++s)
        weak_stress.push_back(
          problem
            .materials[region_to_material
                         [point.sides[std::min(s, point.n_sides - 1)].region]]
            .initial_stress);

    owned.reinit(covers.locally_owned_dofs(2), covers.communicator());
    constraints.distribute(owned);
    solution.reinit(covers.locally_owned_dofs(2),
                    covers.locally_relevant_dofs(2),
                    covers.communicator());
    solution = owned;
  }


  bool
  IncrementalElasticity::Data::add_element(const unsigned int       element,
                                           const LocalDisplacement &u,
                                           LocalSystem             &local) const
  {
    const Moduli &moduli =
      region_to_moduli[covers->manifold_mesh().region(element)];
    const ElementTables::View table = tables(element);
    const unsigned int        first = tables.first_point(element);
    double                    g[WeightFunctions::max_per_cell][2];
    for (unsigned int q = 0; q < table.n_points; ++q)
    {
      const double(*reference)[2] = table.gradients + q * n_per_cell;
      const Tensor<2, 2> F =
        deformation_gradient(n_per_cell, u.values, reference);
      const double J = dealii::determinant(F);
      if (!(J > 0.))
        return false;
      push_forward(n_per_cell, dealii::invert(F), reference, g);
      const double weight = J * table.weights[q];
      add_stiffness(n_per_cell, weight, g, moduli.A, local);
      const SymmetricTensor<2, 2> &s = stress[first + q];
      for (unsigned int i = 0; i < n_per_cell; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          local.rhs[2 * i + c] +=
            weight * (s[c][0] * g[i][0] + s[c][1] * g[i][1]);
    }
    symmetrize(local);
    return true;
  }


  bool
  IncrementalElasticity::Data::locate(const WeakPoint         &point,
                                      const LocalDisplacement &u,
                                      CurrentPoint            &current) const
  {
    for (unsigned int s = 0; s < point.n_sides; ++s)
    {
      const Tensor<2, 2> F = deformation_gradient(n_per_cell,
                                                  u.values + s * n_per_cell,
                                                  point.sides[s].gradients);
      const double       J = dealii::determinant(F);
      if (!(J > 0.))
        return false;
      const Tensor<2, 2> inverse = dealii::invert(F);
      push_forward(n_per_cell,
                   inverse,
                   point.sides[s].gradients,
                   current.gradients[s]);
      if (s == 0)
      {
        current.normal       = J * (dealii::transpose(inverse) * point.normal);
        current.length_ratio = current.normal.norm();
        current.normal /= current.length_ratio;
      }
    }
    return true;
  }


  /// Add Nitsche's terms of StaticElasticity on the current geometry. Returns false if an element
  /// is turned inside out.
  bool
  IncrementalElasticity::Data::add_weak_points(const EdgeTables::Site &site,
                                               const double load_factor,
                                               const LocalDisplacement &u,
                                               LocalSystem &local) const
  {
    CurrentPoint current;
    for (unsigned int q = site.first_point; q < site.last_point; ++q)
    {
      const WeakPoint &point = edges->weak_points[q];
      if (!locate(point, u, current))
        return false;
      Tensor<1, 2> jump, traction;
      for (unsigned int k = 0; k < local.n_covers; ++k)
        for (unsigned int a = 0; a < 2; ++a)
          jump[a] += point.jump[k] * u.values[k][a];
      for (unsigned int s = 0; s < point.n_sides; ++s)
        traction +=
          point.sides[s].share * (weak_stress[2 * q + s] * current.normal);
      add_nitsche(point,
                  WeakTraction(point,
                               n_per_cell,
                               region_to_elasticity,
                               current.normal,
                               {{current.gradients[0], current.gradients[1]}}),
                  point.projection * jump - load_factor * point.prescribed,
                  traction,
                  point.weight * current.length_ratio,
                  1.,
                  local);
    }
    return true;
  }


  /// Assemble the linear system of a step. Returns false if an element is turned inside out.
  bool
  IncrementalElasticity::Data::assemble(const double load_factor)
  {
    LocalSystem       local;
    LocalDisplacement u;
    auto              condition = edges->conditions.begin();
    auto              follower  = edges->followers.begin();
    const auto [first, last]    = covers->locally_owned_elements();
    for (unsigned int e = first; e < last; ++e)
    {
      u.gather(covers->covers(e), nodal);
      local.reset(n_per_cell);
      if (!add_element(e, u, local))
        return false;
      if (condition != edges->conditions.end() && condition->element == e &&
          !add_weak_points(*condition++, load_factor, u, local))
        return false;
      if (follower != edges->followers.end() && follower->element == e)
      {
        for (unsigned int q = follower->first_point; q < follower->last_point;
             ++q)
          add_follower_point(edges->follower_points[q],
                             n_per_cell,
                             load_factor,
                             u,
                             /* with_tangent = */ false,
                             local);
        ++follower;
      }
      for (unsigned int f = 0; f < problem->fixed_points.size(); ++f)
        if (points.fixed_point_elements()[f] == e)
          add_fixed_point(*covers,
                          e,
                          problem->fixed_points[f],
                          points.stiffness(f),
                          load_factor,
                          u,
                          /* with_tangent = */ true,
                          local);
      assembler.add(covers->covers(e), local.matrix, local.rhs);
    }
    for (const EdgeTables::Site &tie : edges->ties)
    {
      gather(tie, nodal, u);
      local.reset(2 * n_per_cell);
      if (!add_weak_points(tie, load_factor, u, local))
        return false;
      assembler.add({covers_of_tie(tie).data(), 2 * n_per_cell},
                    local.matrix,
                    local.rhs);
    }
    dead_loads.for_each_force(
      [&](const unsigned int k, const Tensor<1, 2> &force) {
        const double f[2] = {-load_factor * force[0], -load_factor * force[1]};
        assembler.add({&k, 1}, nullptr, f);
      });
    return true;
  }


  void
  IncrementalElasticity::Data::update_weak_stress(
    const EdgeTables::Site  &site,
    const LocalDisplacement &u,
    const LocalDisplacement &increment)
  {
    CurrentPoint current;
    for (unsigned int q = site.first_point; q < site.last_point; ++q)
    {
      const WeakPoint &point = edges->weak_points[q];
      locate(point, u, current);
      for (unsigned int s = 0; s < point.n_sides; ++s)
      {
        SymmetricTensor<2, 2> &sigma = weak_stress[2 * q + s];
        sigma                        = updated_stress(sigma,
                               region_to_elasticity[point.sides[s].region],
                               gradient(n_per_cell,
                                        increment.values + s * n_per_cell,
                                        current.gradients[s]));
      }
    }
  }


  void
  IncrementalElasticity::Data::update_stress()
  {
    LocalDisplacement u, increment;
    double            g[WeightFunctions::max_per_cell][2];
    const auto [first, last] = covers->locally_owned_elements();
    for (unsigned int e = first; e < last; ++e)
    {
      u.gather(covers->covers(e), nodal);
      increment.gather(covers->covers(e), nodal_increment);
      const ElementTables::View table = tables(e);
      const PlaneElasticity    &elasticity =
        region_to_elasticity[covers->manifold_mesh().region(e)];
      for (unsigned int q = 0; q < table.n_points; ++q)
      {
        const double(*reference)[2] = table.gradients + q * n_per_cell;
        push_forward(n_per_cell,
                     dealii::invert(
                       deformation_gradient(n_per_cell, u.values, reference)),
                     reference,
                     g);
        SymmetricTensor<2, 2> &sigma = stress[tables.first_point(e) + q];
        sigma                        = updated_stress(sigma,
                               elasticity,
                               gradient(n_per_cell, increment.values, g));
      }
    }
    for (const auto *sites : {&edges->conditions, &edges->ties})
      for (const EdgeTables::Site &site : *sites)
      {
        gather(site, nodal, u);
        gather(site, nodal_increment, increment);
        update_weak_stress(site, u, increment);
      }
  }


  IncrementalElasticity::IncrementalElasticity(
    const CoverSystem                       &covers,
    const QuadratureCollection              &quadrature,
    const dealii::AffineConstraints<double> &constraints,
    const ElasticityProblem                 &problem,
    const bool                               may_float)
    : data(std::make_unique<Data>(covers,
                                  quadrature,
                                  constraints,
                                  problem,
                                  may_float))
  {
  }


  IncrementalElasticity::~IncrementalElasticity() = default;


  double
  IncrementalElasticity::step(const double load_factor)
  {
    return step(load_factor, {});
  }


  double
  IncrementalElasticity::step(
    const double load_factor,
    const std::function<void(const Matrix &, const Vector &, Vector &)> &solve)
  {
    return try_step(load_factor, std::numeric_limits<double>::infinity(), solve)
      .largest_displacement;
  }


  IncrementalElasticity::StepResult
  IncrementalElasticity::try_step(
    const double load_factor,
    const double max_displacement,
    const std::function<void(const Matrix &, const Vector &, Vector &)> &solve)
  {
    Data          &d            = *data;
    const MPI_Comm communicator = d.covers->communicator();
    read_nodal_values(*d.covers, d.solution, d.nodal);
    d.assembler.reset();
    const bool is_good = d.assemble(load_factor);
    d.assembler.compress();
    AssertThrow(dealii::Utilities::MPI::min(is_good ? 1 : 0, communicator) == 1,
                NumericalFailure("An element is turned inside out",
                                 "load factor " + std::to_string(load_factor),
                                 "take smaller steps, or finite kinematics"));
    d.correction.reinit(d.residual);
    if (solve)
      solve(d.matrix, d.residual, d.correction);
    else
    {
      d.direct_solver.factorize(d.matrix);
      d.direct_solver.solve(d.residual, d.correction);
    }

    Vector end(d.owned);
    end -= d.correction;
    d.constraints->distribute(end);
    Vector increment(d.solution), owned_increment(end);
    owned_increment -= d.owned;
    increment = owned_increment;
    read_nodal_values(*d.covers, increment, d.nodal_increment);

    double largest = 0.;
    for (const auto k : d.covers->locally_owned_covers())
      largest =
        std::max(largest, d.nodal_increment[d.covers->local_cover(k)].norm());
    StepResult result;
    result.largest_displacement =
      dealii::Utilities::MPI::max(largest, communicator);
    AssertThrow(std::isfinite(result.largest_displacement),
                NumericalFailure("The displacements are not finite",
                                 "load factor " + std::to_string(load_factor),
                                 "see whether the solid is held, and take "
                                 "smaller steps"));
    result.is_taken = result.largest_displacement <= max_displacement;
    if (result.is_taken)
    {
      d.owned    = end;
      d.solution = d.owned;
      d.update_stress();
      d.add_work(load_factor);
    }
    return result;
  }


  void
  IncrementalElasticity::Data::add_work(const double load_factor)
  {
    double work = 0.;
    dead_loads.for_each_force(
      [&](const unsigned int k, const Tensor<1, 2> &force) {
        work += load_factor * force * nodal_increment[k];
      });
    work_of_loads += dealii::Utilities::MPI::sum(work, covers->communicator());
  }


  IncrementalElasticity::State
  IncrementalElasticity::state() const
  {
    return {data->owned, data->stress, data->weak_stress, data->work_of_loads};
  }


  void
  IncrementalElasticity::restore(const State &state)
  {
    AssertThrow(state.solution.size() == data->owned.size() &&
                  state.stress.size() == data->stress.size() &&
                  state.weak_stress.size() == data->weak_stress.size(),
                InputError("The state of another problem",
                           "incremental kinematics",
                           "restore a state of the same one"));
    data->owned         = state.solution;
    data->solution      = data->owned;
    data->stress        = state.stress;
    data->weak_stress   = state.weak_stress;
    data->work_of_loads = state.work_of_loads;
  }


  double
  IncrementalElasticity::work_of_loads() const
  {
    return data->work_of_loads;
  }


  double
  IncrementalElasticity::strain_energy() const
  {
    const Data               &d = *data;
    std::vector<Tensor<1, 2>> nodal;
    read_nodal_values(*d.covers, d.solution, nodal);
    LocalDisplacement u;
    double            energy = 0.;
    const auto [first, last] = d.covers->locally_owned_elements();
    for (unsigned int e = first; e < last; ++e)
    {
      u.gather(d.covers->covers(e), nodal);
      const ElementTables::View table = d.tables(e);
      const PlaneElasticity    &elasticity =
        d.region_to_elasticity[d.covers->manifold_mesh().region(e)];
      const double share =
        elasticity.lambda / (2. * (elasticity.lambda + elasticity.mu));
      for (unsigned int q = 0; q < table.n_points; ++q)
      {
        const SymmetricTensor<2, 2> &sigma =
          d.stress[d.tables.first_point(e) + q];
        const double trace = dealii::trace(sigma);
        const double area =
          table.weights[q] *
          dealii::determinant(deformation_gradient(
            d.n_per_cell, u.values, table.gradients + q * d.n_per_cell));
        energy +=
          area * (sigma * sigma - share * trace * trace) / (4. * elasticity.mu);
      }
    }
    return dealii::Utilities::MPI::sum(energy, d.covers->communicator());
  }


  const IncrementalElasticity::Vector &
  IncrementalElasticity::solution() const
  {
    return data->solution;
  }


  const std::vector<SymmetricTensor<2, 2>> &
  IncrementalElasticity::stresses() const
  {
    return data->stress;
  }
} // namespace NMM
