#ifndef nmm_tests_contact_contact_model_h
#define nmm_tests_contact_contact_model_h

#include <nmm/contact/assembly/statics.h>
#include <nmm/covers/graded_mesh.h>

#include <gtest/gtest.h>
#include <mechanics/finite_model.h>
#include <optional>
#include <support/coulomb.h>

namespace NMM
{
  namespace Test
  {
    /// Bodies with everything that contact needs, in the order it is made. The
    /// problem is filled in before start().
    class Bodies
    {
    public:
      struct Options
      {
        unsigned int               degree              = 2;
        double                     cell_size           = 0.3;
        double                     rotation            = 0.;
        Tensor<1, 2>               offset              = Tensor<1, 2>();
        bool                       mesh_of_every_block = false;
        MPI_Comm                   communicator        = MPI_COMM_WORLD;
        std::vector<RigidObstacle> obstacles;
        /// Instead of a regular mesh.
        std::optional<GradedMeshParameters> graded_mesh;
      };

      Bodies(Geometry geometry, const Options &options)
        : physical_mesh(std::move(geometry))
        , meshes(make_own_meshes(
            std::make_unique<MathematicalMesh>(
              options.graded_mesh
                ? make_graded_mesh(physical_mesh,
                                   *options.graded_mesh,
                                   options.degree)
                : make_regular_mesh(physical_mesh,
                                    mesh_parameters(options.cell_size,
                                                    options.offset,
                                                    options.rotation),
                                    options.degree)),
            physical_mesh,
            own_mesh_parameters(options.mesh_of_every_block)))
        , mesh(*meshes.manifold_mesh)
        , covers(make_covers(mesh, options.communicator))
        , surface(covers, options.obstacles)
        , aggregation(aggregate(covers))
        , constraints(make_constraints(covers, aggregation, 2))
        , quadrature(mesh,
                     2 * options.degree,
                     2 * options.degree,
                     covers.locally_owned_elements())
      {
        problem.plane_state = PlaneState::plane_strain;
        problem.materials   = {material()};
      }

      /// Make the elasticity, the contact and the solver of the problem.
      void
      start(const ContactParameters &parameters,
            const bool               is_linearized = true,
            const NewtonParameters  &newton =
              ContactStatics::default_newton_parameters())
      {
        elasticity = std::make_unique<FiniteElasticity>(
          covers, quadrature, constraints, problem, /* may_float = */ true);
        static_solid = make_solid_at_rest(*elasticity,
                                          is_linearized ? Kinematics::small
                                                        : Kinematics::finite);
        contact = std::make_unique<Contact>(surface, constraints, parameters);
        statics =
          std::make_unique<ContactStatics>(*static_solid, *contact, newton);
      }

      /// Values of a function of the reference position and the block, at the
      /// covers' nodes; locally relevant.
      Vector
      interpolate(const std::function<Tensor<1, 2>(const Point<2> &,
                                                   unsigned int)> &function)
      {
        std::vector<unsigned int> cover_to_block(covers.n_covers(), 0);
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
          for (const unsigned int cover : covers.covers(e))
            cover_to_block[cover] = mesh.block(e);
        Vector owned(covers.locally_owned_dofs(2), covers.communicator());
        for (const auto k : covers.locally_owned_covers())
        {
          const Tensor<1, 2> u = function(covers.node(k), cover_to_block[k]);
          for (unsigned int c = 0; c < 2; ++c)
            owned(2 * k + c) = u[c];
        }
        owned.compress(dealii::VectorOperation::insert);
        constraints.distribute(owned);
        return relevant(owned);
      }

      Vector
      relevant(const Vector &owned) const
      {
        Vector result(covers.locally_owned_dofs(2),
                      covers.locally_relevant_dofs(2),
                      covers.communicator());
        result = owned;
        return result;
      }

      /// A point inside of every element: the mean of its edges' ends.
      Point<2>
      inner_point(const unsigned int element) const
      {
        Tensor<1, 2> sum;
        const auto   edges = mesh.edges(element);
        if (edges.size() == 0)
          return mesh.mathematical_mesh().reference_to_real(mesh.cell(element),
                                                            {0.3, 0.3});
        for (const ElementEdge &edge : edges)
          sum += edge.start;
        return Point<2>(sum / static_cast<double>(edges.size()));
      }

      /// Largest |stress - expected| over elements, the solution being one of
      /// small displacements [Pa].
      double
      stress_error(const SymmetricTensor<2, 2> &expected) const
      {
        const DisplacementField field(covers, problem, statics->solution());
        double                  error = 0.;
        const auto [first, last]      = covers.locally_owned_elements();
        for (unsigned int e = first; e < last; ++e)
          for (const Point<2> &xi : sample_points(e))
            error = std::max(error, (field.stress(e, xi) - expected).norm());
        return dealii::Utilities::MPI::max(error, covers.communicator());
      }

      /// Largest difference of displacement gradients within a block [-].
      double
      gradient_spread() const
      {
        const DisplacementField   field(covers, problem, statics->solution());
        const unsigned int        n_blocks = physical_mesh.n_blocks();
        std::vector<Tensor<2, 2>> known(n_blocks);
        std::vector<bool>         is_known(n_blocks, false);
        double                    spread = 0.;
        const auto [first, last]         = covers.locally_owned_elements();
        for (unsigned int e = first; e < last; ++e)
          for (const Point<2> &xi : sample_points(e))
          {
            const Tensor<2, 2> gradient = field.gradient(e, xi);
            const unsigned int block    = mesh.block(e);
            if (!is_known[block])
              known[block] = gradient;
            is_known[block] = true;
            spread = std::max(spread, (gradient - known[block]).norm());
          }
        return dealii::Utilities::MPI::max(spread, covers.communicator());
      }

      PhysicalMesh                      physical_mesh;
      OwnMeshes                         meshes;
      const ManifoldMesh               &mesh;
      CoverSystem                       covers;
      ContactSurface                    surface;
      Aggregation                       aggregation;
      dealii::AffineConstraints<double> constraints;
      QuadratureCollection              quadrature;
      ElasticityProblem                 problem;
      std::unique_ptr<FiniteElasticity> elasticity;
      std::unique_ptr<SolidTerm>        static_solid;
      std::unique_ptr<Contact>          contact;
      std::unique_ptr<ContactStatics>   statics;

    private:
      static CoverSystem
      make_covers(const ManifoldMesh &mesh, const MPI_Comm communicator)
      {
        CoverSystem covers(mesh, communicator);
        covers.make_boundary_relevant();
        return covers;
      }

      static OwnMeshParameters
      own_mesh_parameters(const bool every_region)
      {
        OwnMeshParameters parameters;
        parameters.every_region = every_region;
        return parameters;
      }

      /// Corners and middle of the element's outline, in its cell.
      std::vector<Point<2>>
      sample_points(const unsigned int element) const
      {
        const unsigned int    cell = mesh.cell(element);
        std::vector<Point<2>> points;
        for (const ElementEdge &edge : mesh.edges(element))
          points.push_back(
            mesh.mathematical_mesh().real_to_reference(cell, edge.start));
        if (points.empty())
          points = {{0., 0.}, {1., 0.}, {0., 1.}, {0.3, 0.3}};
        return points;
      }
    };


    /// A rectangle whose sides are named @p prefix + bottom, right, top, left.
    inline void
    add_named_box(Geometry          &geometry,
                  const std::string &prefix,
                  const Point<2>    &lower,
                  const Point<2>    &upper)
    {
      const Point<2> corners[4] = {lower,
                                   {upper[0], lower[1]},
                                   upper,
                                   {lower[0], upper[1]}};
      const char    *names[4]   = {"bottom", "right", "top", "left"};
      for (unsigned int i = 0; i < 4; ++i)
        geometry.add(single_piece_curve(
          prefix + names[i],
          CurvePiece::segment(corners[i], corners[(i + 1) % 4])));
    }


    /// Straight pieces through points, the body on the left.
    inline RigidObstacle
    obstacle(const std::string &name, const std::vector<Point<2>> &points)
    {
      RigidObstacle result;
      result.name = name;
      for (unsigned int i = 0; i + 1 < points.size(); ++i)
        result.pieces.push_back(CurvePiece::segment(points[i], points[i + 1]));
      return result;
    }


    /// Hold the component of a point; its reaction is zero where nothing
    /// else pushes that way.
    inline FixedPoint
    guide(const Point<2> &point, const bool in_x, const bool in_y = false)
    {
      FixedPoint fixed;
      fixed.point         = point;
      fixed.components[0] = in_x;
      fixed.components[1] = in_y;
      return fixed;
    }


    inline ContactParameters
    contact_parameters(const double normal_stiffness, const double reach = 0.05)
    {
      ContactParameters parameters;
      coulomb(parameters).normal_stiffness = normal_stiffness;
      parameters.reach                     = reach;
      return parameters;
    }
  } // namespace Test
} // namespace NMM

#endif
