#include <nmm/linear_algebra/condition_number.h>
#include <nmm/mechanics/mass_matrix.h>
#include <nmm/quadrature/element_quadrature.h>

#include <support/hard_cases/hard_cases.h>

namespace NMM
{
  namespace HardCases
  {
    namespace
    {
      /// Outward unit normal of an edge of the solid at @p x on a curve made of
      /// segments and circles: what a traction needs.
      Tensor<1, 2>
      normal_of_curve(const PhysicalMesh &mesh,
                      const std::string  &name,
                      const Point<2>     &x)
      {
        const CurvePiece *nearest = nullptr;
        double            best    = 1e300;
        for (const unsigned int c : mesh.find_curves(name))
          for (const CurvePiece &piece : mesh.curves()[c].pieces)
          {
            double d;
            if (piece.kind == CurvePiece::Kind::segment)
            {
              const Tensor<1, 2> along = piece.end - piece.start;
              const double       t =
                std::clamp(((x - piece.start) * along) / along.norm_square(),
                           0.,
                           1.);
              d = x.distance(piece.start + t * along);
            }
            else
              d = std::abs(x.distance(piece.center) - piece.radius);
            if (d < best)
            {
              best    = d;
              nearest = &piece;
            }
          }
        // boundaries run counter-clockwise here
        if (nearest->kind == CurvePiece::Kind::segment)
        {
          const Tensor<1, 2> along = (nearest->end - nearest->start) /
                                     (nearest->end - nearest->start).norm();
          return Tensor<1, 2>({along[1], -along[0]});
        }
        return (x - nearest->center) / (x - nearest->center).norm();
      }


      /// Relative error in the energy norm, by rules of degree 2p + 4.
      double
      energy_error(const Model &model, const SmoothField &field)
      {
        const unsigned int degree = 2 * model.mathematical_mesh.degree() + 4;
        const auto         owned  = model.covers.locally_owned_elements();
        const QuadratureCollection quadrature(model.manifold_mesh,
                                              degree,
                                              degree,
                                              owned);
        const auto                 region_to_material =
          model.problem.region_to_material(model.physical_mesh);
        double error = 0., norm = 0.;
        for (unsigned int element = owned.first; element < owned.second;
             ++element)
        {
          const PlaneElasticity e =
            model.problem
              .materials[region_to_material[model.manifold_mesh.region(
                element)]]
              .plane_elasticity(model.problem.plane_state);
          const auto energy = [&](const Tensor<2, 2> &g) {
            return e.stress(g) * symmetrize(g);
          };
          const unsigned int cell = model.manifold_mesh.cell(element);
          const double       det = 2. * model.mathematical_mesh.cell_area(cell);
          const auto        &rule = quadrature.rule(element);
          for (unsigned int q = 0; q < rule.size(); ++q)
          {
            const Tensor<2, 2> exact = field.gradient(
              model.mathematical_mesh.reference_to_real(cell, rule.point(q)));
            error +=
              det * rule.weight(q) *
              energy(model.field->gradient(element, rule.point(q)) - exact);
            norm += det * rule.weight(q) * energy(exact);
          }
        }
        return norm > 0. ? std::sqrt(error / norm) : std::sqrt(error);
      }


      double
      mass_condition(const Model &model)
      {
        dealii::TrilinosWrappers::SparseMatrix mass;
        assemble_mass_matrix(model.covers,
                             *model.quadrature,
                             model.constraints,
                             model.problem,
                             model.ghost_penalty.get(),
                             mass);
        return estimate_condition_number(mass, model.covers, model.constraints)
          .value();
      }
    } // namespace


    void
    prescribe(Model                                    &model,
              const std::shared_ptr<const SmoothField> &field,
              const Material                           &material,
              const PlaneState                          plane_state,
              const std::vector<std::string>           &held,
              const std::vector<std::string>           &loaded)
    {
      model.problem.plane_state = plane_state;
      model.problem.materials   = {material};
      const PlaneElasticity e   = material.plane_elasticity(plane_state);
      model.problem.body_force  = vector_function(
        [=](const Point<2> &x) { return field->body_force(x, e); });
      for (const std::string &name : held)
        model.problem.boundary_conditions.push_back(
          condition(BoundaryCondition::Type::displacement,
                    name,
                    vector_function([=](const Point<2> &x) {
                      return field->displacement(x);
                    })));
      for (const std::string &name : loaded)
        model.problem.boundary_conditions.push_back(
          condition(BoundaryCondition::Type::traction,
                    name,
                    vector_function([=, &model](const Point<2> &x) {
                      return e.stress(field->gradient(x)) *
                             normal_of_curve(model.physical_mesh, name, x);
                    })));
    }


    Result
    measure(Model              &model,
            const SmoothField  &field,
            const std::string  &variant,
            const Stabilization stabilization,
            const Measure      &what)
    {
      Result result;
      result.variant       = variant;
      result.stabilization = stabilization;
      result.n_unknowns =
        2 * (model.covers.n_covers() - model.aggregation.cover_to_root.size());
      for (unsigned int e = 0; e < model.manifold_mesh.n_elements(); ++e)
        result.smallest_fraction = std::min(result.smallest_fraction,
                                            model.manifold_mesh.area(e) /
                                              model.mathematical_mesh.cell_area(
                                                model.manifold_mesh.cell(e)));
      for (Material &material : model.problem.materials)
        material.density = 1.;
      try
      {
        model.solve();
        result.energy_error = energy_error(model, field);
        result.displacement_error =
          compute_errors(
            *model.field,
            [&](const Point<2> &x) { return field.displacement(x); },
            [&](const Point<2> &) { return SymmetricTensor<2, 2>(); })
            .displacement;
        if (what.condition)
        {
          result.stiffness_condition =
            estimate_condition_number(model.system->system_matrix(),
                                      model.covers,
                                      model.constraints)
              .value();
          result.mass_condition = mass_condition(model);
        }
        if (what.cg_iterations)
        {
          LinearSolverParameters parameters;
          parameters.type      = LinearSolverParameters::Type::iterative;
          parameters.tolerance = 1e-10;
          result.cg_iterations = model.system->solve(parameters).n_iterations;
        }
      }
      catch (const NumericalFailure &failure)
      {
        result.failure = failure.what();
      }
      return result;
    }
  } // namespace HardCases
} // namespace NMM
