// A cylinder on a rigid plate against Hertz, as in step-nmm-3.

#include "step-nmm-3/hertz.h"

#include <nmm/contact/assembly/statics.h>

#include "staged_model.h"
#include <support/coulomb.h>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      using Type = BoundaryCondition::Type;
      using StepNMM3::Enforcement;

      /// Counts and times its assemblies: ContactStatics assembles the contact
      /// once with each of them.
      class TimedSolid : public SmallSolid
      {
      public:
        explicit TimedSolid(FiniteElasticity &elasticity)
          : SmallSolid(elasticity,
                       proportional_loading(elasticity.elasticity_problem()))
        {
        }

        Deformation
        assemble(const Trial &trial, AssembledForces &sum) override
        {
          if (trial.tangent == Tangent::none)
            ++n_residuals;
          else
            ++n_tangents;
          // only the first iteration of a solution knows of no increment
          if (trial.tangent == Tangent::robust && trial.increment == nullptr)
            ++n_solutions;
          dealii::Timer     timer;
          const Deformation state = SmallSolid::assemble(trial, sum);
          seconds += timer.wall_time();
          return state;
        }

        unsigned int n_tangents = 0, n_residuals = 0, n_solutions = 0;
        double       seconds = 0.;
      };


      Geometry
      quarter_disk(const double R)
      {
        const double s = std::sqrt(0.5) * R;
        Geometry     geometry;
        geometry.add(
          single_piece_curve("arc",
                             CurvePiece::arc({0., -R}, {s, -s}, {R, 0.})));
        geometry.add(
          single_piece_curve("middle", CurvePiece::segment({R, 0.}, {0., 0.})));
        geometry.add(
          single_piece_curve("axis", CurvePiece::segment({0., 0.}, {0., -R})));
        return geometry;
      }


      GradedMeshParameters
      mesh_of(const StepNMM3::Parameters &parameters,
              const double                half_width,
              const double                size)
      {
        GradedMeshParameters mesh;
        mesh.cell_size    = parameters.cell_size;
        mesh.offset       = parameters.placement.offset;
        mesh.rotation     = parameters.placement.rotation;
        const double wide = 1.1 * half_width;
        LocalSize    box;
        box.kind         = LocalSize::Kind::box;
        box.lower        = Point<2>(-wide, -parameters.radius - 0.2 * wide);
        box.upper        = Point<2>(wide, -parameters.radius + 0.2 * wide);
        box.size         = size;
        box.growth       = parameters.growth;
        mesh.local_sizes = {box};
        return mesh;
      }


      void
      compare(const StepNMM3::Hertz &hertz,
              const StagedModel     &model,
              const Contact         &contact,
              Row                   &row)
      {
        std::vector<StepNMM3::PressurePoint> points;
        double                               force = 0.;
        for (const ContactPoint &point : contact.points())
          if (point.master != invalid_index)
          {
            const auto place =
              model.surface->reference_place(point.edge, point.s);
            points.push_back(
              {std::abs(place.x[0]), point.pressure, point.weight});
            force += point.weight * point.pressure * std::abs(point.normal[1]);
          }
        // a quarter has half of the contact
        const Tutorial::Row errors =
          StepNMM3::compare(hertz, 2. * force, points);
        row.error             = number(errors, "L2_p_%") / 100.;
        row.second_error      = std::abs(number(errors, "force_%")) / 100.;
        row.error_kind        = "L2 of pressure";
        row.second_error_kind = "force";
      }


      /// What one search and one assembly of the contact take at the solution, times
      /// how many there were.
      void
      measure_contact(const TimedSolid &solid,
                      const Vector     &u,
                      Contact          &contact,
                      Row              &row)
      {
        const auto seconds_of = [](const std::function<void()> &action) {
          double least = std::numeric_limits<double>::max();
          for (unsigned int i = 0; i < 3; ++i)
          {
            dealii::Timer timer;
            action();
            least = std::min(least, timer.wall_time());
          }
          return least;
        };
        row.search =
          solid.n_solutions * seconds_of([&]() { contact.detect(u); });
        row.contact =
          solid.n_residuals *
            seconds_of([&]() { contact.assemble(u, false); }) +
          solid.n_tangents * seconds_of([&]() { contact.assemble(u, true); });
      }


      Row
      run(const Enforcement enforcement, const double ratio)
      {
        const StepNMM3::Parameters parameters;
        const double               R = parameters.radius, half_width = 0.1 * R;
        const StepNMM3::Hertz      hertz =
          StepNMM3::Hertz::from_half_width(parameters, half_width);
        const double size = ratio * half_width;

        Row row;
        row.name        = "Hertz disk";
        row.method      = "manifold refined";
        row.kinematics  = "small";
        row.enforcement = enforcement == Enforcement::penalty
                            ? "penalty"
                            : "augmented Lagrangian";
        row.solver      = "MUMPS";
        StagedModel::Options options;
        options.has_contact = true;
        RigidObstacle plate;
        plate.name        = "plate";
        plate.pieces      = {CurvePiece::segment({2. * R, -R}, {-2. * R, -R})};
        options.obstacles = {plate};
        StagedModel model(quarter_disk(R),
                          mesh_of(parameters, half_width, size),
                          options,
                          row);
        model.problem.plane_state         = PlaneState::plane_strain;
        model.problem.materials           = {material("cylinder",
                                            parameters.youngs_modulus,
                                            parameters.poissons_ratio)};
        model.problem.boundary_conditions = {
          condition(Type::normal_displacement, "axis"),
          condition(Type::normal_displacement,
                    "middle",
                    constant(-0.5 * hertz.approach))};

        const bool        is_augmented = enforcement == Enforcement::augmented;
        ContactParameters contact_parameters;
        coulomb(contact_parameters).normal_stiffness =
          (is_augmented ? 10. : 30.) * parameters.youngs_modulus / size;
        if (is_augmented)
          contact_parameters.penetration_tolerance = 1e-4 * hertz.approach;
        contact_parameters.reach = 0.05 * R;
        FiniteElasticity elasticity(*model.covers,
                                    *model.quadrature,
                                    model.constraints,
                                    model.problem);
        TimedSolid       solid(elasticity);
        Contact contact(*model.surface, model.constraints, contact_parameters);
        ContactStatics statics(solid, contact);
        row.steps = row.iterations = 0.;
        for (const ContactStep &step : statics.run(LoadSteps::equal(1)))
        {
          row.steps += 1.;
          row.iterations += step.n_iterations + step.n_lost_iterations;
        }
        const double solution = model.lap();
        row.total             = model.total();
        row.assembly          = solid.seconds;
        row.nonzeros          = contact.tangent().n_nonzero_elements();
        compare(hertz, model, contact, row);
        measure_contact(solid, statics.solution(), contact, row);
        row.factorization =
          std::max(0., solution - row.assembly - row.search - row.contact);
        return row;
      }
    } // namespace


    void
    measure_hertz(Recorder &recorder)
    {
      std::vector<double> ratios = {0.4};
      if (recorder.size() != Size::smallest)
        ratios.insert(ratios.end(), {0.2, 0.1});
      if (recorder.size() == Size::full)
        ratios.push_back(0.05);
      for (const Enforcement enforcement :
           {Enforcement::penalty, Enforcement::augmented})
        for (const double ratio : ratios)
          recorder.record([&]() { return run(enforcement, ratio); });
    }
  } // namespace Bench
} // namespace NMM
