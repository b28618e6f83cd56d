// Energy of a plate with an edge crack in tension, which is an open joint that ends
// inside.

#include "staged_model.h"

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      using Type = BoundaryCondition::Type;

      /// Edge lengths far from the tip and there [m].
      struct Plate
      {
        double       cell_size = 0.2, tip_size = 0.2, growth = 0.2;
        unsigned int degree = 2;
      };

      constexpr double width = 1., half_height = 2., crack = 0.5,
                       youngs_modulus = 1000., tension = 1.;


      Row
      run(const Plate &plate, double &energy)
      {
        Row row;
        row.name       = "cracked plate";
        row.method     = plate.tip_size < plate.cell_size ? "manifold refined"
                                                          : "manifold uniform";
        row.kinematics = "small";
        row.error_kind = "energy";
        Geometry geometry;
        add_box(geometry, {0., -half_height}, {width, half_height});
        geometry.add_polyline({{0., 0.}, {crack, 0.}},
                              "crack",
                              CurveRole::joint,
                              JointState::open);
        GradedMeshParameters mesh;
        mesh.cell_size = plate.cell_size;
        mesh.offset    = Tensor<1, 2>({0.013, 0.021});
        mesh.rotation  = 7.;
        if (plate.tip_size < plate.cell_size)
        {
          LocalSize tip;
          tip.point        = Point<2>(crack, 0.);
          tip.size         = plate.tip_size;
          tip.growth       = plate.growth;
          mesh.local_sizes = {tip};
        }
        StagedModel::Options options;
        options.degree = plate.degree;
        StagedModel model(std::move(geometry), mesh, options, row);
        model.problem.plane_state = PlaneState::plane_stress;
        model.problem.materials   = {material("plate", youngs_modulus, 0.3)};
        for (const double sign : {1., -1.})
          model.problem.boundary_conditions.push_back(
            condition(Type::traction,
                      sign > 0. ? "top" : "bottom",
                      vector_function([sign](const Point<2> &) {
                        return Tensor<1, 2>({0., sign * tension});
                      })));
        // the loads are in balance: these carry nothing
        FixedPoint pin, slider;
        pin.point                  = Point<2>(0.75, 0.);
        slider.point               = Point<2>(0.95, 0.);
        slider.components[0]       = false;
        model.problem.fixed_points = {pin, slider};
        LinearSolverParameters direct;
        direct.type = LinearSolverParameters::Type::direct;
        model.solve(direct, row);

        // half of the work of the loads
        Vector u(model.elasticity->system_rhs());
        u      = model.elasticity->solution();
        energy = 0.5 * (u * model.elasticity->system_rhs());
        return row;
      }
    } // namespace


    void
    measure_cracked_plate(Recorder &recorder)
    {
      const bool is_smallest = recorder.size() == Size::smallest;
      // the smallest triangles at the tip that a mesh may have
      const auto least_tip = [](const double cell_size) {
        return 2e-6 * cell_size;
      };
      double exact = 0.;
      recorder.record([&]() {
        const double size = is_smallest ? 0.1 : 0.02;
        Row          row  = run({size, least_tip(size), 4. * size, 2}, exact);
        row.name          = "cracked plate reference";
        row.error_kind    = "";
        return row;
      });

      std::vector<double> cell_sizes = {0.2, 0.1};
      if (!is_smallest)
        cell_sizes.insert(cell_sizes.end(), {0.05, 0.025});
      if (recorder.size() == Size::full)
        cell_sizes.push_back(0.0125);
      const auto series = [&](const unsigned int degree, const double power) {
        for (const double cell_size : cell_sizes)
        {
          // finer ones come near to the reference
          if (power == 4. && cell_size < 0.04)
            continue;
          recorder.record([&]() {
            // as h^power
            const double tip    = power == 1.
                                    ? cell_size
                                    : std::max(least_tip(cell_size),
                                            0.2 * std::pow(cell_size, power));
            double       energy = 0.;
            Row          row =
              run({cell_size, tip, std::min(1., 2. * cell_size), degree},
                  energy);
            row.error = std::abs(energy / exact - 1.);
            return row;
          });
        }
      };
      series(1, 1.);
      series(2, 1.);
      series(1, 2.);
      series(2, 4.);
    }
  } // namespace Bench
} // namespace NMM
