#ifndef nmm_tests_mechanics_model_h
#define nmm_tests_mechanics_model_h

#include <nmm/base/exceptions.h>
#include <nmm/covers/aggregation.h>
#include <nmm/covers/own_meshes.h>
#include <nmm/mechanics/displacement_field.h>
#include <nmm/mechanics/elasticity_problem.h>
#include <nmm/mechanics/error_norms.h>
#include <nmm/mechanics/static_elasticity.h>
#include <nmm/mechanics/stress_recovery.h>

#include <deal.II/base/function_lib.h>
#include <deal.II/base/mpi.h>

#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace NMM
{
  namespace Test
  {
    using dealii::Point;
    using dealii::SymmetricTensor;
    using dealii::Tensor;

    /// A pentagon, so that no side is parallel to the mesh by accident.
    const std::vector<Point<2>> pentagon = {{0., 0.},
                                            {1.1, 0.1},
                                            {1.3, 0.9},
                                            {0.4, 1.2},
                                            {-0.2, 0.6}};

    /// A vector function of position.
    class VectorFunction : public dealii::Function<2>
    {
    public:
      using F = std::function<Tensor<1, 2>(const Point<2> &)>;

      explicit VectorFunction(F f)
        : dealii::Function<2>(2)
        , f(std::move(f))
      {
      }

      double
      value(const Point<2> &x, const unsigned int component) const override
      {
        return f(x)[component];
      }

    private:
      F f;
    };


    inline std::shared_ptr<VectorFunction>
    vector_function(VectorFunction::F f)
    {
      return std::make_shared<VectorFunction>(std::move(f));
    }


    inline std::shared_ptr<dealii::Function<2>>
    constant(const double value)
    {
      return std::make_shared<dealii::Functions::ConstantFunction<2>>(value);
    }


    inline Material
    material(const std::string &name    = "rock",
             const double       E       = 1000.,
             const double       nu      = 0.25,
             const double       density = 0.)
    {
      Material m;
      m.name           = name;
      m.youngs_modulus = E;
      m.poissons_ratio = nu;
      m.density        = density;
      return m;
    }


    constexpr auto normal_displacement =
      BoundaryCondition::Type::normal_displacement;


    inline BoundaryCondition
    condition(const BoundaryCondition::Type                    type,
              const std::string                               &curve,
              const std::shared_ptr<const dealii::Function<2>> value = nullptr)
    {
      BoundaryCondition c;
      c.name  = curve;
      c.curve = curve;
      c.type  = type;
      c.value = value;
      return c;
    }


    inline Curve
    single_piece_curve(const std::string &name,
                       const CurvePiece  &piece,
                       const CurveRole    role = CurveRole::boundary)
    {
      Curve curve;
      curve.name   = name;
      curve.role   = role;
      curve.pieces = {piece};
      return curve;
    }


    /// A rectangle with its sides named bottom, right, top, left.
    inline void
    add_box(Geometry &geometry, const Point<2> &lower, const Point<2> &upper)
    {
      const Point<2> corners[4] = {lower,
                                   {upper[0], lower[1]},
                                   upper,
                                   {lower[0], upper[1]}};
      const char    *names[4]   = {"bottom", "right", "top", "left"};
      for (unsigned int i = 0; i < 4; ++i)
        geometry.add(single_piece_curve(
          names[i], CurvePiece::segment(corners[i], corners[(i + 1) % 4])));
    }


    /// A ring's part between the angles 0 and 90 degrees: bottom, outer, left,
    /// inner.
    inline Geometry
    quarter_ring(const double a, const double b)
    {
      const double s = std::sqrt(0.5);
      Geometry     geometry;
      geometry.add(
        single_piece_curve("bottom", CurvePiece::segment({a, 0}, {b, 0})));
      geometry.add(
        single_piece_curve("outer",
                           CurvePiece::arc({b, 0}, {b * s, b * s}, {0, b})));
      geometry.add(
        single_piece_curve("left", CurvePiece::segment({0, b}, {0, a})));
      geometry.add(
        single_piece_curve("inner",
                           CurvePiece::arc({0, a}, {a * s, a * s}, {a, 0})));
      return geometry;
    }


    /// Everything from geometry to the solution, in the order it is made.
    class Model
    {
    public:
      Model(Geometry                     geometry,
            const RegularMeshParameters &mesh_parameters,
            const unsigned int           degree,
            const Stabilization stabilization = Stabilization::aggregation,
            const MPI_Comm      communicator  = MPI_COMM_WORLD)
        : Model(
            std::move(geometry),
            [&](const PhysicalMesh &mesh) {
              return make_regular_mesh(mesh, mesh_parameters, degree);
            },
            stabilization,
            communicator)
      {
      }

      /// With any mathematical mesh.
      Model(
        Geometry                                                     geometry,
        const std::function<MathematicalMesh(const PhysicalMesh &)> &make_mesh,
        const Stabilization stabilization = Stabilization::aggregation,
        const MPI_Comm      communicator  = MPI_COMM_WORLD)
        : physical_mesh(std::move(geometry))
        , meshes(make_own_meshes(std::make_unique<MathematicalMesh>(
                                   make_mesh(physical_mesh)),
                                 physical_mesh))
        , mathematical_mesh(*meshes.mathematical_mesh)
        , manifold_mesh(*meshes.manifold_mesh)
        , covers(manifold_mesh, communicator)
      {
        const unsigned int degree = mathematical_mesh.degree();
        if (stabilization == Stabilization::aggregation)
        {
          aggregation = aggregate(covers);
          constraints = make_constraints(covers, aggregation, 2);
        }
        else
          constraints.close();
        if (stabilization == Stabilization::ghost_penalty)
          ghost_penalty =
            std::make_unique<GhostPenalty>(make_ghost_penalty(manifold_mesh));
        quadrature = std::make_unique<QuadratureCollection>(
          manifold_mesh,
          2 * degree,
          2 * degree,
          covers.locally_owned_elements());
      }

      LinearSolverReport
      solve(const LinearSolverParameters &parameters = {})
      {
        system = std::make_unique<StaticElasticity>(covers,
                                                    *quadrature,
                                                    constraints,
                                                    problem,
                                                    ghost_penalty.get(),
                                                    disks);
        system->assemble();
        const LinearSolverReport report = system->solve(parameters);
        field = std::make_unique<DisplacementField>(covers,
                                                    problem,
                                                    system->solution());
        for (unsigned int i = 0; i < disks.size(); ++i)
          field->add_disk(*disks[i], system->disk_coefficients()[i]);
        return report;
      }

      /// Element and reference coordinates of a point.
      std::pair<unsigned int, Point<2>>
      locate(const Point<2> &x) const
      {
        const unsigned int element = manifold_mesh.find_element(x);
        AssertThrow(element != invalid_index,
                    dealii::ExcMessage("not in the solid"));
        return {element,
                mathematical_mesh.real_to_reference(manifold_mesh.cell(element),
                                                    x)};
      }

      Tensor<1, 2>
      displacement(const Point<2> &x) const
      {
        const auto [element, xi] = locate(x);
        return field->displacement(element, xi);
      }

      SymmetricTensor<2, 2>
      stress(const Point<2> &x) const
      {
        const auto [element, xi] = locate(x);
        return field->stress(element, xi);
      }

      PhysicalMesh                          physical_mesh;
      OwnMeshes                             meshes;
      const MathematicalMesh               &mathematical_mesh;
      const ManifoldMesh                   &manifold_mesh;
      CoverSystem                           covers;
      Aggregation                           aggregation;
      dealii::AffineConstraints<double>     constraints;
      std::unique_ptr<GhostPenalty>         ghost_penalty;
      std::unique_ptr<QuadratureCollection> quadrature;
      ElasticityProblem                     problem;
      std::vector<const DiskCover *>        disks;
      std::unique_ptr<StaticElasticity>     system;
      std::unique_ptr<DisplacementField>    field;
    };


    inline RegularMeshParameters
    mesh_parameters(const double        cell_size,
                    const Tensor<1, 2> &offset   = Tensor<1, 2>(),
                    const double        rotation = 0.)
    {
      RegularMeshParameters parameters;
      parameters.cell_size = cell_size;
      parameters.offset    = offset;
      parameters.rotation  = rotation;
      return parameters;
    }


    /// A displacement that is a quadratic polynomial, with stress and body force.
    struct QuadraticField
    {
      Tensor<1, 2>          constant;
      Tensor<2, 2>          linear;
      SymmetricTensor<2, 2> quadratic[2];

      Tensor<1, 2>
      displacement(const Point<2> &x) const
      {
        Tensor<1, 2> u = constant + linear * x;
        for (unsigned int c = 0; c < 2; ++c)
          u[c] += x * (quadratic[c] * x);
        return u;
      }

      Tensor<2, 2>
      gradient(const Point<2> &x) const
      {
        Tensor<2, 2> g = linear;
        for (unsigned int c = 0; c < 2; ++c)
          g[c] += 2. * (quadratic[c] * x);
        return g;
      }

      /// f = -div sigma, constant.
      Tensor<1, 2>
      body_force(const PlaneElasticity &e) const
      {
        Tensor<1, 2> f;
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
            // sigma_ij,j = lambda u_j,ji + mu (u_i,jj + u_j,ij)
            f[i] -= 2. * ((e.lambda + e.mu) * quadratic[j][i][j] +
                          e.mu * quadratic[i][j][j]);
        return f;
      }
    };


    /// Random numbers in [-1, 1] from @p generator.
    template <typename Generator>
    QuadraticField
    random_field(Generator &generator, const unsigned int degree)
    {
      std::uniform_real_distribution<double> random(-1., 1.);
      QuadraticField                         field;
      for (unsigned int c = 0; c < 2; ++c)
      {
        field.constant[c] = random(generator);
        for (unsigned int d = 0; d < 2; ++d)
          field.linear[c][d] = random(generator);
        if (degree == 2)
        {
          field.quadratic[c][0][0] = random(generator);
          field.quadratic[c][0][1] = random(generator);
          field.quadratic[c][1][1] = random(generator);
        }
      }
      return field;
    }


    /// The largest of the ranks' values.
    inline double
    maximum_over_ranks(const double value)
    {
      return dealii::Utilities::MPI::max(value, MPI_COMM_WORLD);
    }
  } // namespace Test
} // namespace NMM

#endif
