#ifndef nmm_tests_mechanics_finite_model_h
#define nmm_tests_mechanics_finite_model_h

#include <nmm/mechanics/finite_elasticity.h>
#include <nmm/mechanics/nonlinear_statics.h>

#include <mechanics/model.h>

namespace NMM
{
  namespace Test
  {
    using Vector = FiniteElasticity::Vector;

    inline std::unique_ptr<FiniteElasticity>
    finite_elasticity(Model &model)
    {
      return std::make_unique<FiniteElasticity>(model.covers,
                                                *model.quadrature,
                                                model.constraints,
                                                model.problem);
    }


    /// Locally relevant values of a function of the reference position at the
    /// covers' nodes, constraints distributed.
    inline Vector
    interpolate(const Model                                         &model,
                const std::function<Tensor<1, 2>(const Point<2> &)> &function)
    {
      const MPI_Comm communicator = model.covers.communicator();
      Vector         owned(model.covers.locally_owned_dofs(2), communicator);
      for (const auto k : model.covers.locally_owned_covers())
      {
        const Tensor<1, 2> u = function(model.covers.node(k));
        for (unsigned int c = 0; c < 2; ++c)
          owned(2 * k + c) = u[c];
      }
      owned.compress(dealii::VectorOperation::insert);
      model.constraints.distribute(owned);
      Vector result(model.covers.locally_owned_dofs(2),
                    model.covers.locally_relevant_dofs(2),
                    communicator);
      result = owned;
      return result;
    }


    /// A box from (0,0) to (2,1) with a crack, a closed joint and an interface
    /// between two materials, on a mesh that is turned.
    inline std::unique_ptr<Model>
    jointed_box(const unsigned int                        degree,
                const std::shared_ptr<const MaterialLaw> &law,
                const PlaneState                          state,
                const double                              cell_size = 0.22,
                const MPI_Comm communicator = MPI_COMM_WORLD)
    {
      Geometry geometry;
      add_box(geometry, {0., 0.}, {2., 1.});
      geometry.add_polyline({{0.3, 0.2}, {0.7, 0.8}},
                            "crack",
                            CurveRole::joint,
                            JointState::closed);
      geometry.add_polyline({{1.1, -0.1}, {1.25, 1.1}},
                            "tied",
                            CurveRole::joint,
                            JointState::closed);
      geometry.add_polyline({{-0.1, 0.55}, {2.1, 0.45}},
                            "layer",
                            CurveRole::interface);
      geometry.add_material_point({0.1, 0.1}, "rock");
      geometry.add_material_point({0.1, 0.9}, "soil");
      geometry.add_material_point({1.9, 0.1}, "rock");
      geometry.add_material_point({1.9, 0.9}, "soil");
      auto model                 = std::make_unique<Model>(std::move(geometry),
                                           mesh_parameters(cell_size, {}, 9.),
                                           degree,
                                           Stabilization::aggregation,
                                           communicator);
      model->problem.plane_state = state;
      model->problem.materials   = {material("rock", 1000., 0.2, 2.),
                                    material("soil", 300., 0.35, 1.)};
      for (Material &m : model->problem.materials)
        m.law = law;
      return model;
    }


    /// |a - b| / |b| on owned unknowns.
    inline double
    relative_difference(const Vector &a, const Vector &b)
    {
      Vector difference(b.locally_owned_elements(), b.get_mpi_communicator()),
        reference(difference);
      difference = a;
      reference  = b;
      difference -= reference;
      return difference.l2_norm() / reference.l2_norm();
    }
  } // namespace Test
} // namespace NMM

#endif
