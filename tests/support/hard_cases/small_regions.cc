#include <cstdio>
#include <support/hard_cases/hard_cases.h>

namespace NMM
{
  namespace HardCases
  {
    namespace
    {
      /// A column 0 < y < 1 between smooth walls: sigma_yy = -p - w (1 - y),
      /// u_y' = sigma_yy / M with the oedometer modulus M of each layer.
      class LayeredField : public SmoothField
      {
      public:
        /// Layers end at @p tops (the last at 1) and have the moduli @p M.
        LayeredField(std::vector<double> tops,
                     std::vector<double> M,
                     const double        p,
                     const double        w)
          : tops(std::move(tops))
          , M(std::move(M))
          , p(p)
          , w(w)
        {
        }

        Tensor<1, 2>
        displacement(const Point<2> &x) const override
        {
          double u = 0., from = 0.;
          for (unsigned int i = 0; i < tops.size(); ++i)
          {
            const double to = std::min(tops[i], x[1]);
            if (to <= from)
              break;
            // the mean of a linear stress is that of the middle
            u += stress(0.5 * (from + to)) * (to - from) / M[i];
            from = to;
          }
          return Tensor<1, 2>({0., u});
        }

        Tensor<2, 2>
        gradient(const Point<2> &x) const override
        {
          unsigned int i = 0;
          while (i + 1 < tops.size() && x[1] > tops[i])
            ++i;
          Tensor<2, 2> g;
          g[1][1] = stress(x[1]) / M[i];
          return g;
        }

        Tensor<1, 2>
        body_force(const Point<2> &, const PlaneElasticity &) const override
        {
          return Tensor<1, 2>({0., -w});
        }

        double
        stress(const double y) const
        {
          return -p - w * (1. - y);
        }

      private:
        std::vector<double> tops, M;
        double              p, w;
      };


      /// u = omega x (x - center).
      class RotationField : public SmoothField
      {
      public:
        explicit RotationField(const Point<2> &center)
          : center(center)
        {
        }

        Tensor<1, 2>
        displacement(const Point<2> &x) const override
        {
          return Tensor<1, 2>({-(x - center)[1], (x - center)[0]});
        }

        Tensor<2, 2>
        gradient(const Point<2> &) const override
        {
          Tensor<2, 2> g;
          g[0][1] = -1.;
          g[1][0] = 1.;
          return g;
        }

        Tensor<1, 2>
        body_force(const Point<2> &, const PlaneElasticity &) const override
        {
          return Tensor<1, 2>();
        }

      private:
        Point<2> center;
      };


      std::string
      text(const char *format, const double a, const double b = 0.)
      {
        char result[80];
        std::snprintf(result, sizeof(result), format, a, b);
        return result;
      }
    } // namespace


    Result
    thin_layer(const double        thickness,
               const double        contrast,
               const Stabilization stabilization,
               const Measure      &what)
    {
      constexpr double h = 1. / 6., bottom = 0.45;
      const double     top = bottom + thickness * h;
      Geometry         geometry;
      add_box(geometry, {0., 0.}, {1., 1.});
      geometry.add_polyline({{-0.1, bottom}, {1.1, bottom}},
                            "lower joint",
                            CurveRole::joint,
                            JointState::closed);
      geometry.add_polyline({{-0.1, top}, {1.1, top}},
                            "upper joint",
                            CurveRole::joint,
                            JointState::closed);
      geometry.add_material_point({0.5, 0.2}, "rock");
      geometry.add_material_point({0.5, 0.8}, "rock");
      geometry.add_material_point({0.5, 0.5 * (bottom + top)}, "gouge");
      Model model(std::move(geometry),
                  mesh_parameters(h, Tensor<1, 2>({0.03, 0.05}), 13.),
                  2,
                  stabilization);
      model.problem.plane_state = PlaneState::plane_strain;
      model.problem.materials   = {material("rock", 1000., 0.3),
                                   material("gouge", 1000. * contrast, 0.3)};
      const auto modulus        = [&](const unsigned int m) {
        const PlaneElasticity e =
          model.problem.materials[m].plane_elasticity(PlaneState::plane_strain);
        return e.lambda + 2. * e.mu;
      };
      const double       p = 3., w = 2.;
      const LayeredField field({bottom, top, 1.},
                               {modulus(0), modulus(1), modulus(0)},
                               p,
                               w);
      model.problem.body_force = vector_function([=](const Point<2> &) {
        return Tensor<1, 2>({0., -w});
      });
      using Type               = BoundaryCondition::Type;
      model.problem.boundary_conditions = {
        condition(Type::normal_displacement, "bottom"),
        condition(Type::normal_displacement, "left"),
        condition(Type::normal_displacement, "right"),
        condition(Type::pressure, "top", constant(p))};
      return measure(model,
                     field,
                     text("layer of %g h, stiffness 1 : %g",
                          thickness,
                          contrast),
                     stabilization,
                     what);
    }


    Result
    sharp_wedges(const double        cell_size,
                 const Stabilization stabilization,
                 const Measure      &what)
    {
      Geometry geometry;
      add_box(geometry, {0., 0.}, {1., 1.});
      const double slope = std::tan(dealii::numbers::PI / 180.);
      geometry.add_polyline({{-0.1, 0.4}, {1.1, 0.4}},
                            "level",
                            CurveRole::joint,
                            JointState::closed);
      geometry.add_polyline({{-0.1, 0.4 - 0.4 * slope},
                             {1.1, 0.4 + 0.8 * slope}},
                            "rising",
                            CurveRole::joint,
                            JointState::closed);
      Model      model(std::move(geometry),
                  mesh_parameters(cell_size, Tensor<1, 2>({0.03, 0.05}), 13.),
                  2,
                  stabilization);
      const auto field = make_polynomial_field(5, 2);
      prescribe(model,
                field,
                material("rock", 1000., 0.3),
                PlaneState::plane_strain,
                {"bottom", "right", "top", "left"},
                {});
      return measure(model,
                     *field,
                     text("joints crossing at 1 degree, h = %g", cell_size),
                     stabilization,
                     what);
    }


    const std::string &
    to_string(const Shape shape)
    {
      static const std::string names[] = {"square", "triangle", "disk"};
      return names[static_cast<unsigned int>(shape)];
    }


    namespace
    {
      /// Corners of a regular polygon about @p center, counter-clockwise.
      std::vector<Point<2>>
      regular_polygon(const Point<2>    &center,
                      const double       radius,
                      const unsigned int n)
      {
        std::vector<Point<2>> corners;
        for (unsigned int i = 0; i < n; ++i)
        {
          const double t = (20. + 360. * i / n) * dealii::numbers::PI / 180.;
          corners.push_back(center +
                            radius * Tensor<1, 2>({std::cos(t), std::sin(t)}));
        }
        return corners;
      }


      /// The block's boundary in two pieces of the same role: held and loaded if
      /// it is the solid's boundary.
      void
      add_block(Geometry       &geometry,
                const Shape     shape,
                const Point<2> &center,
                const double    size,
                const bool      in_frame)
      {
        const unsigned int          n = shape == Shape::triangle ? 3 : 4;
        const std::vector<Point<2>> corners =
          regular_polygon(center, size / std::sqrt(2.), n);
        Curve curves[2];
        for (unsigned int i = 0; i < n; ++i)
        {
          const Point<2>    &from = corners[i], &to = corners[(i + 1) % n];
          const Tensor<1, 2> middle = 0.5 * ((from - center) + (to - center));
          curves[i == 0 ? 0 : 1].pieces.push_back(
            shape == Shape::disk
              ? CurvePiece::arc(from,
                                center + middle * (size / std::sqrt(2.) /
                                                   middle.norm()),
                                to)
              : CurvePiece::segment(from, to));
        }
        for (unsigned int c = 0; c < 2; ++c)
        {
          curves[c].name  = c == 0 ? "first side" : "other sides";
          curves[c].role  = in_frame ? CurveRole::joint : CurveRole::boundary;
          curves[c].state = JointState::closed;
          geometry.add(curves[c]);
        }
      }
    } // namespace


    Result
    small_block(const Shape         shape,
                const double        size,
                const bool          in_frame,
                const bool          rigid,
                const Stabilization stabilization,
                const Measure      &what)
    {
      constexpr double h = 0.25;
      const Point<2>   center(0.53, 0.47);
      Geometry         geometry;
      if (in_frame)
        add_box(geometry, {0., 0.}, {1., 1.});
      add_block(geometry, shape, center, size * h, in_frame);
      Model                              model(std::move(geometry),
                  mesh_parameters(h, Tensor<1, 2>({0.03, 0.05}), 13.),
                  2,
                  stabilization);
      std::shared_ptr<const SmoothField> field;
      if (rigid)
        field = std::make_shared<RotationField>(center);
      else
        field = make_polynomial_field(3, 1, center);
      if (in_frame)
        prescribe(model,
                  field,
                  material("rock", 1., 0.3),
                  PlaneState::plane_strain,
                  {"bottom", "right", "top", "left"},
                  {});
      else
        prescribe(model,
                  field,
                  material("rock", 1., 0.3),
                  PlaneState::plane_strain,
                  {"first side"},
                  {"other sides"});
      return measure(model,
                     *field,
                     to_string(shape) + text(" of %g h", size) +
                       (in_frame ? " in a frame" : " alone") +
                       (rigid ? ", rotation" : ", constant stress"),
                     stabilization,
                     what);
    }
  } // namespace HardCases
} // namespace NMM
