// The cantilever of the paper's Fig. 10, as in step-nmm-2.

#include "step-nmm-2/cantilever.h"

#include <nmm/materials/material.h>

#include "staged_model.h"
#include "step-nmm-2/incremental_elasticity.h"

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      using Type = BoundaryCondition::Type;
      using StepNMM2::Load;

      struct Cantilever
      {
        Load         load      = Load::dead;
        double       cell_size = 0.33;
        unsigned int degree    = 2;
        /// Of the incremental scheme.
        unsigned int n_steps = 100;
      };


      GradedMeshParameters
      mesh_of(const Cantilever           &cantilever,
              const StepNMM2::Parameters &parameters)
      {
        GradedMeshParameters mesh;
        mesh.cell_size = cantilever.cell_size;
        mesh.offset    = parameters.placement.offset;
        mesh.rotation  = parameters.placement.rotation;
        for (const double y : {0., parameters.height})
        {
          LocalSize corner;
          corner.point  = Point<2>(0., y);
          corner.size   = parameters.corner_ratio * cantilever.cell_size;
          corner.growth = parameters.corner_growth;
          mesh.local_sizes.push_back(corner);
        }
        return mesh;
      }


      ElasticityProblem
      problem_of(const Cantilever           &cantilever,
                 const StepNMM2::Parameters &parameters)
      {
        ElasticityProblem problem;
        problem.plane_state         = PlaneState::plane_stress;
        problem.materials           = {material("beam",
                                      parameters.youngs_modulus,
                                      parameters.poissons_ratio)};
        problem.materials[0].law    = material_law("St. Venant-Kirchhoff");
        problem.boundary_conditions = {condition(Type::displacement, "left")};
        const double half           = 0.5 * parameters.force();
        for (const std::string side : {"top", "bottom"})
          problem.boundary_conditions.push_back(
            cantilever.load == Load::dead
              ? condition(Type::traction,
                          side,
                          vector_function([half](const Point<2> &) {
                            return Tensor<1, 2>({0., -half});
                          }))
              : condition(Type::follower_pressure,
                          side,
                          constant(side == "top" ? half : -half)));
        return problem;
      }


      /// -v / L by K.
      using Deflections = std::map<double, double>;

      /// What all kinematics have in common; @p solve fills in the deflections.
      Row
      run(const Cantilever                 &cantilever,
          const std::string                &kinematics,
          const std::function<void(StagedModel &,
                                   Deflections &,
                                   const StepNMM2::Parameters &,
                                   Row &)> &solve)
      {
        const StepNMM2::Parameters parameters;
        Row                        row;
        row.name       = "cantilever " + StepNMM2::name(cantilever.load);
        row.method     = "manifold refined";
        row.kinematics = kinematics;
        row.solver     = "MUMPS";
        row.error_kind = "largest of the deflection";
        Geometry geometry;
        add_box(geometry, {0., 0.}, {parameters.length, parameters.height});
        StagedModel::Options options;
        options.degree = cantilever.degree;
        StagedModel model(std::move(geometry),
                          mesh_of(cantilever, parameters),
                          options,
                          row);
        model.problem = problem_of(cantilever, parameters);
        Deflections deflections;
        solve(model, deflections, parameters, row);
        row.error = StepNMM2::largest_error(cantilever.load, deflections);
        return row;
      }


      double
      deflection(const StagedModel          &model,
                 const StepNMM2::Parameters &parameters,
                 const DisplacementField    &field)
      {
        const double L = parameters.length, H = parameters.height;
        return -model.displacement(field, {L, 0.5 * H}, {0.5 * L, 0.5 * H})[1] /
               L;
      }


      Row
      run_finite(const Cantilever &cantilever)
      {
        return run(cantilever,
                   "finite",
                   [](StagedModel                &model,
                      Deflections                &deflections,
                      const StepNMM2::Parameters &parameters,
                      Row                        &row) {
                     FiniteElasticity elasticity(*model.covers,
                                                 *model.quadrature,
                                                 model.constraints,
                                                 model.problem);
                     NonlinearStatics statics(elasticity);
                     row.steps = row.iterations = row.assembly =
                       row.factorization = row.solution = 0.;
                     statics.run(
                       LoadSteps::equal(parameters.n_load_steps),
                       [&](const LoadStep &step, const Vector &u) {
                         deflections[parameters.last_load * step.load_factor] =
                           deflection(model,
                                      parameters,
                                      {*model.covers, model.problem, u});
                         row.steps += 1.;
                         row.iterations += step.newton.iterations.size() +
                                           step.n_lost_iterations;
                         row.assembly += step.newton.assembly_time;
                         row.factorization += step.newton.factorization_time;
                         row.solution += step.newton.substitution_time;
                       });
                     model.lap();
                     row.total    = model.total();
                     row.nonzeros = elasticity.tangent().n_nonzero_elements();
                   });
      }


      Row
      run_incremental(const Cantilever &cantilever)
      {
        return run(
          cantilever,
          "incremental",
          [&](StagedModel                &model,
              Deflections                &deflections,
              const StepNMM2::Parameters &parameters,
              Row                        &row) {
            StepNMM2::IncrementalElasticity elasticity(*model.covers,
                                                       *model.quadrature,
                                                       model.constraints,
                                                       model.problem);
            const unsigned int              n = cantilever.n_steps;
            row.solver                        = "UMFPACK";
            for (unsigned int k = 1; k <= n; ++k)
            {
              elasticity.step(static_cast<double>(k) / n);
              if (parameters.n_load_steps * k % n == 0)
                deflections[parameters.last_load * k / n] = deflection(
                  model,
                  parameters,
                  {*model.covers, model.problem, elasticity.displacements()});
            }
            model.lap();
            row.steps = row.iterations = n;
            row.total                  = model.total();
          });
      }


      /// One linear solution for all loads: what small displacements make of large ones.
      Row
      run_small(const Cantilever &cantilever)
      {
        return run(cantilever,
                   "small",
                   [](StagedModel                &model,
                      Deflections                &deflections,
                      const StepNMM2::Parameters &parameters,
                      Row                        &row) {
                     LinearSolverParameters direct;
                     direct.type = LinearSolverParameters::Type::direct;
                     model.solve(direct, row);
                     const double w =
                       deflection(model,
                                  parameters,
                                  {*model.covers,
                                   model.problem,
                                   model.elasticity->solution()});
                     const unsigned int n = parameters.n_load_steps;
                     for (unsigned int k = 1; k <= n; ++k)
                       deflections[parameters.last_load * k / n] = w * k / n;
                     row.steps = 1.;
                   });
      }
    } // namespace


    void
    measure_cantilever(Recorder &recorder)
    {
      std::vector<double>       cell_sizes = {0.6, 0.33};
      std::vector<unsigned int> increments = {10};
      if (recorder.size() != Size::smallest)
      {
        cell_sizes.insert(cell_sizes.end(), {0.22, 0.139});
        increments.insert(increments.end(), {20, 50, 100});
      }
      if (recorder.size() == Size::full)
      {
        cell_sizes.push_back(0.09);
        increments.insert(increments.end(), {200, 500, 1000});
      }
      for (const Load load : StepNMM2::loads)
      {
        Cantilever cantilever;
        cantilever.load = load;
        recorder.record([&]() { return run_small(cantilever); });
        for (const unsigned int degree : {1, 2})
          for (const double cell_size : cell_sizes)
          {
            cantilever.degree    = degree;
            cantilever.cell_size = cell_size;
            recorder.record([&]() { return run_finite(cantilever); });
          }
        cantilever      = Cantilever();
        cantilever.load = load;
        for (const unsigned int n : increments)
        {
          cantilever.n_steps = n;
          recorder.record([&]() { return run_incremental(cantilever); });
        }
      }
    }
  } // namespace Bench
} // namespace NMM
