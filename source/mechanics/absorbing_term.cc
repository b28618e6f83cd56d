#include <nmm/base/archive.h>
#include <nmm/covers/manifold_mesh.h>
#include <nmm/mechanics/absorbing_term.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <base/hash.h>
#include <cmath>
#include <limits>
#include <linear_algebra/cover_matrix_assembler.h>
#include <mechanics/curve_conditions.h>
#include <mechanics/free_field_column.h>
#include <mechanics/local_system.h>

namespace NMM
{
  using dealii::Tensor;

  using internal::FreeFieldColumn;

  namespace
  {
    /// The matrix Z at a boundary with the normal @p n [Pa s/m].
    Tensor<2, 2>
    impedance(const double           density,
              const PlaneElasticity &moduli,
              const Tensor<1, 2>    &n)
    {
      const double Z_p = std::sqrt(density * (moduli.lambda + 2. * moduli.mu)),
                   Z_s = std::sqrt(density * moduli.mu);
      Tensor<2, 2> Z   = (Z_p - Z_s) * outer_product(n, n);
      for (unsigned int c = 0; c < 2; ++c)
        Z[c][c] += Z_s;
      return Z;
    }


    /// Twice the traction of the incoming wave at the amplitude 1 [Pa].
    Tensor<1, 2>
    twice_the_wave(const BoundaryCondition &condition,
                   const dealii::Point<2>  &x,
                   const Tensor<2, 2>      &Z)
    {
      Tensor<1, 2> value;
      for (unsigned int c = 0; c < 2; ++c)
        value[c] = condition.value->value(x, c);
      return condition.wave == BoundaryCondition::Wave::stress
               ? 2. * value
               : 2. * (Z * value);
    }
  } // namespace


  struct AbsorbingTerm::Data
  {
    /// An edge of an element of this rank on an absorbing boundary.
    struct Edge
    {
      unsigned int    condition, element;
      EdgeRule        rule;
      double          y_0, y_1, density;
      PlaneElasticity moduli;
    };

    /// The forces of one boundary condition at the amplitude 1 [N/m].
    struct Wave
    {
      unsigned int condition;
      Vector       forces;
    };

    /// A column, and the traction of the wave at its base.
    struct FreeField
    {
      unsigned int    condition;
      FreeFieldColumn column;
      Tensor<1, 2>    wave;
    };

    Data(const CoverSystem                    &covers,
         const ModelLayout                    &layout,
         const ElasticityProblem              &problem,
         std::function<LoadAmplitudes(double)> amplitudes);

    /// Traction on the solid at the point @p q of an edge [Pa].
    using Traction = std::function<Tensor<1, 2>(const Edge &, unsigned int q)>;

    void
    find_edges();

    /// Add the dashpots of all edges, or else the forces of a traction on the edges of a condition, to
    /// the assembly.
    void
    add(unsigned int condition = invalid_index, const Traction &traction = {});

    void
    assemble_boundaries();

    void
    make_free_fields(const RayleighDamping &damping);

    double
    amplitude(unsigned int condition, double t) const;

    /// The traction of the wave at the base of a column at the time @p t [Pa].
    std::array<double, 2>
    base_traction(const FreeField &field, double t) const;

    /// Set `forces` to r of the term at the time @p t [s], without the dashpots.
    void
    compute_forces(double t);

    dealii::Point<2>
    place(const Edge &edge, const unsigned int q) const
    {
      const ManifoldMesh &mesh = covers->manifold_mesh();
      return mesh.mathematical_mesh().reference_to_real(mesh.cell(edge.element),
                                                        edge.rule.points[q]);
    }

    const CoverSystem                    *covers;
    const ModelLayout                    *layout;
    const ElasticityProblem              *problem;
    std::function<LoadAmplitudes(double)> amplitudes;
    std::vector<bool>                     absent_blocks;
    std::vector<Edge>                     edges;
    /// The dashpots [kg/(m s)], and the right-hand side of their assembly.
    Matrix                         dashpots;
    Vector                         rhs;
    internal::CoverMatrixAssembler assembler;
    std::vector<Wave>              waves;
    std::vector<FreeField>         free_fields;
    Vector                         held, forces;
    /// Time at the beginning of the step, and its length [s].
    double begin_of_step = 0., length_of_step = 0.;
  };


  AbsorbingTerm::Data::Data(const CoverSystem                    &covers,
                            const ModelLayout                    &layout,
                            const ElasticityProblem              &problem,
                            std::function<LoadAmplitudes(double)> amplitudes)
    : covers(&covers)
    , layout(&layout)
    , problem(&problem)
    , amplitudes(std::move(amplitudes))
    , assembler(covers, *layout.constraints)
    , held(layout.locally_owned, layout.communicator)
    , forces(held)
  {
    assembler.ignore_inhomogeneities();
    assembler.leave_empty_rows();
    assembler.build(dashpots, rhs);
    find_edges();
    assemble_boundaries();
  }


  void
  AbsorbingTerm::Data::find_edges()
  {
    using namespace internal;
    const ManifoldMesh             &mesh = covers->manifold_mesh();
    const std::vector<unsigned int> region_to_material =
      problem->region_to_material(mesh.physical_mesh());
    const CurveConditions conditions(mesh, *problem);
    const auto [first, last] = covers->locally_owned_elements();
    for (unsigned int e = first; e < last; ++e)
      for (const ElementEdge &edge : mesh.edges(e))
        for (const unsigned int c : conditions.conditions(e, edge))
          if (problem->boundary_conditions[c].is_absorbing())
          {
            const Material &material =
              problem->materials[region_to_material[mesh.region(e)]];
            edges.push_back(
              {c,
               e,
               make_edge_rule(edge,
                              cell_frame(mesh, e),
                              2 * mesh.mathematical_mesh().degree()),
               std::min(edge.start[1], edge.end[1]),
               std::max(edge.start[1], edge.end[1]),
               material.density,
               material.plane_elasticity(problem->plane_state)});
          }
  }


  void
  AbsorbingTerm::Data::add(const unsigned int condition,
                           const Traction    &traction)
  {
    const MathematicalMesh &cells = covers->manifold_mesh().mathematical_mesh();
    const unsigned int      n     = cells.n_covers_per_cell();
    internal::LocalSystem   local;
    double                  w[WeightFunctions::max_per_cell];
    for (const Edge &edge : edges)
    {
      if ((traction && edge.condition != condition) ||
          (!absent_blocks.empty() &&
           absent_blocks[covers->manifold_mesh().block(edge.element)]))
        continue;
      local.reset(n);
      for (unsigned int q = 0; q < edge.rule.points.size(); ++q)
      {
        const Tensor<2, 2> Z =
          impedance(edge.density, edge.moduli, edge.rule.normals[q]);
        const Tensor<1, 2> t = traction ? traction(edge, q) : Tensor<1, 2>();
        WeightFunctions::values(cells.degree(), edge.rule.points[q], w);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int c = 0; c < 2; ++c)
          {
            const double weight = edge.rule.weights[q] * w[i];
            local.rhs[unknown_of(i, c)] += weight * t[c];
            for (unsigned int j = 0; j < n && !traction; ++j)
              for (unsigned int d = 0; d < 2; ++d)
                local.row(i, c)[unknown_of(j, d)] += weight * w[j] * Z[c][d];
          }
      }
      assembler.add(covers->covers(edge.element),
                    traction ? nullptr : local.matrix,
                    local.rhs);
    }
  }


  void
  AbsorbingTerm::Data::assemble_boundaries()
  {
    assembler.reset();
    add();
    assembler.compress();
    waves.clear();
    for (unsigned int c = 0; c < problem->boundary_conditions.size(); ++c)
    {
      const BoundaryCondition &condition = problem->boundary_conditions[c];
      if (condition.type != BoundaryCondition::Type::absorbing ||
          condition.value == nullptr)
        continue;
      assembler.reset(/* with_matrix = */ false);
      add(c, [&](const Edge &edge, const unsigned int q) {
        return twice_the_wave(condition,
                              place(edge, q),
                              impedance(edge.density,
                                        edge.moduli,
                                        edge.rule.normals[q]));
      });
      assembler.compress(/* with_matrix = */ false);
      waves.push_back({c, rhs});
    }
  }


  void
  AbsorbingTerm::Data::make_free_fields(const RayleighDamping &damping)
  {
    for (unsigned int c = 0; c < problem->boundary_conditions.size(); ++c)
    {
      const BoundaryCondition &condition = problem->boundary_conditions[c];
      if (condition.type != BoundaryCondition::Type::free_field)
        continue;
      const std::string where = "boundary condition '" + condition.name + "'";
      // of each edge: y_0, y_1, density, lambda, mu, x, and how much the normal is inclined
      std::vector<std::array<double, 7>> own;
      for (const Edge &edge : edges)
        if (edge.condition == c && !edge.rule.points.empty())
          own.push_back({{edge.y_0,
                          edge.y_1,
                          edge.density,
                          edge.moduli.lambda,
                          edge.moduli.mu,
                          place(edge, 0)[0],
                          std::abs(edge.rule.normals[0][1])}});
      std::vector<FreeFieldColumn::Layer> layers;
      double                              incline = 0.;
      dealii::Point<2>                    base;
      for (const auto &part :
           dealii::Utilities::MPI::all_gather(layout->communicator, own))
        for (const std::array<double, 7> &e : part)
        {
          if (layers.empty() || e[0] < base[1])
            base = {e[5], e[0]};
          layers.push_back({e[0], e[1], e[2], e[3], e[4]});
          incline = std::max(incline, e[6]);
        }
      AssertThrow(incline < 1e-6,
                  InputError("The side of a free field is not vertical",
                             where,
                             "make it so, or set 'Type = absorbing'"));
      FreeField field{c, FreeFieldColumn(layers, damping, where), {}};
      if (condition.value != nullptr)
      {
        Tensor<2, 2> Z;
        for (unsigned int d = 0; d < 2; ++d)
          Z[d][d] = field.column.impedance(d);
        field.wave = twice_the_wave(condition, base, Z);
      }
      free_fields.push_back(std::move(field));
    }
  }


  double
  AbsorbingTerm::Data::amplitude(const unsigned int condition,
                                 const double       t) const
  {
    const std::vector<double> all =
      amplitudes ? amplitudes(t).boundary_conditions : std::vector<double>();
    return all.empty() ? 1. : all[condition];
  }


  std::array<double, 2>
  AbsorbingTerm::Data::base_traction(const FreeField &field,
                                     const double     t) const
  {
    const double factor = amplitude(field.condition, t);
    return {{factor * field.wave[0], factor * field.wave[1]}};
  }


  void
  AbsorbingTerm::Data::compute_forces(const double t)
  {
    forces = held;
    for (const Wave &wave : waves)
      forces.add(-amplitude(wave.condition, t), wave.forces);
    if (free_fields.empty())
      return;
    const double share =
      length_of_step > 0. ? (t - begin_of_step) / length_of_step : 0.;
    for (const FreeField &field : free_fields)
    {
      assembler.reset(/* with_matrix = */ false);
      add(field.condition, [&](const Edge &edge, const unsigned int q) {
        const Tensor<1, 2>           &n = edge.rule.normals[q];
        const FreeFieldColumn::Motion motion =
          field.column.at(place(edge, q)[1], share);
        Tensor<1, 2> t =
          impedance(edge.density, edge.moduli, n) * motion.velocity;
        // sigma_xx = lambda w_y' and sigma_xy = mu w_x' on a vertical side
        t[0] += edge.moduli.lambda * motion.strain[1] * n[0];
        t[1] += edge.moduli.mu * motion.strain[0] * n[0];
        return t;
      });
      assembler.compress(/* with_matrix = */ false);
      forces -= rhs;
    }
  }


  AbsorbingTerm::AbsorbingTerm(const CoverSystem                    &covers,
                               const ModelLayout                    &layout,
                               const ElasticityProblem              &problem,
                               std::function<LoadAmplitudes(double)> amplitudes,
                               const RayleighDamping                &damping)
    : data(
        std::make_unique<Data>(covers, layout, problem, std::move(amplitudes)))
  {
    data->make_free_fields(damping);
    internal::Hash sum;
    for (const BoundaryCondition &condition : problem.boundary_conditions)
      sum.add(condition.is_absorbing()
                ? static_cast<unsigned int>(condition.type)
                : 0U);
    hash = sum.value();
  }


  AbsorbingTerm::~AbsorbingTerm() = default;


  void
  AbsorbingTerm::hold(const Vector &of_supports)
  {
    data->held = of_supports;
    for (const auto i : data->layout->absent_unknowns)
      data->held(i) = 0.;
    data->held.compress(dealii::VectorOperation::insert);
  }


  void
  AbsorbingTerm::begin_step(const StepBegin &step)
  {
    data->begin_of_step  = step.time;
    data->length_of_step = step.length;
    for (Data::FreeField &field : data->free_fields)
      field.column.try_step(step.length,
                            data->base_traction(field, step.time),
                            data->base_traction(field,
                                                step.time + step.length));
  }


  Deformation
  AbsorbingTerm::assemble(const Trial &trial, AssembledForces &sum)
  {
    data->compute_forces(trial.is_conserving
                           ? 0.5 * (trial.begin_time + trial.end_time)
                           : trial.end_time);
    *sum.residual += data->forces;
    sum.scale = std::hypot(sum.scale, data->forces.l2_norm());
    sum.damping.push_back(&data->dashpots);
    return Deformation::admissible;
  }


  StepWork
  AbsorbingTerm::commit(const Trial &step)
  {
    StepWork work;
    if (step.begin == nullptr)
      return work;
    const double t_0 = step.begin_time, t_1 = step.end_time;
    Vector       change(data->held), begin(change), product(change);
    change = *step.end;
    begin  = *step.begin;
    change -= begin;
    data->dashpots.vmult(product, change);
    data->layout->constraints->set_zero(product);
    work.dissipated    = product * change / (t_1 - t_0);
    const auto work_at = [&](const double t) {
      data->compute_forces(t);
      return -(data->forces * change);
    };
    work.loads = step.is_conserving ? work_at(0.5 * (t_0 + t_1))
                                    : 0.5 * (work_at(t_0) + work_at(t_1));
    for (Data::FreeField &field : data->free_fields)
      field.column.accept();
    data->begin_of_step = t_1;
    return work;
  }


  void
  AbsorbingTerm::set_presence(const Presence &presence)
  {
    if (presence.absent_blocks == data->absent_blocks)
      return;
    data->absent_blocks = presence.absent_blocks;
    data->assemble_boundaries();
    hold(Vector(data->held));
  }


  void
  AbsorbingTerm::save(ByteWriter &archive) const
  {
    const ModelLayout                           &layout = *data->layout;
    std::vector<std::pair<unsigned int, double>> own;
    std::vector<unsigned int>                    unknowns;
    std::vector<double>                          values;
    for (const auto i : layout.locally_owned)
      if (data->held(i) != 0.)
        own.emplace_back(i, data->held(i));
    for (const auto &part :
         dealii::Utilities::MPI::all_gather(layout.communicator, own))
      for (const auto &[unknown, value] : part)
      {
        unknowns.push_back(unknown);
        values.push_back(value);
      }
    archive &unknowns &values;
    for (const Data::FreeField &field : data->free_fields)
      archive &field.column.state;
  }


  void
  AbsorbingTerm::restore(ByteReader &archive)
  {
    std::vector<unsigned int> unknowns;
    std::vector<double>       values;
    archive &unknowns        &values;
    const char *const what = "the forces on absorbing boundaries do not fit";
    require_in_checkpoint(unknowns.size() == values.size() &&
                            are_finite(values),
                          what);
    data->held = 0.;
    for (unsigned int k = 0; k < unknowns.size(); ++k)
    {
      require_in_checkpoint(unknowns[k] < data->layout->locally_owned.size(),
                            what);
      if (data->layout->locally_owned.is_element(unknowns[k]))
        data->held(unknowns[k]) = values[k];
    }
    data->held.compress(dealii::VectorOperation::insert);
    for (Data::FreeField &field : data->free_fields)
    {
      FreeFieldColumn &column = field.column;
      archive         &column.state;
      for (unsigned int c = 0; c < 2; ++c)
        for (const std::vector<double> *values :
             {&column.state.w[c], &column.state.v[c]})
          require_in_checkpoint(values->size() == column.n_nodes() &&
                                  are_finite(*values),
                                "the motion of a free field does not fit");
    }
    data->length_of_step = 0.;
  }


  bool
  has_absorbing_boundary(const ElasticityProblem &problem)
  {
    return !releases_of_absorbing(problem).empty();
  }


  std::vector<Release>
  releases_of_absorbing(const ElasticityProblem &problem)
  {
    std::vector<Release> result;
    for (unsigned int c = 0; c < problem.boundary_conditions.size(); ++c)
      if (problem.boundary_conditions[c].is_absorbing())
        result.push_back({Release::Kind::boundary_condition,
                          c,
                          std::numeric_limits<double>::lowest()});
    return result;
  }
} // namespace NMM
