#include <nmm/base/exceptions.h>
#include <nmm/geometry/curve.h>
#include <nmm/mechanics/solid.h>

#include <utility>

namespace NMM
{
  Solid::Solid(std::shared_ptr<const PhysicalMesh> physical_mesh,
               std::unique_ptr<MathematicalMesh>   mathematical_mesh,
               const MPI_Comm                      communicator,
               const SolidParameters              &parameters)
    : blocks(std::move(physical_mesh))
  {
    const auto begin_stage = [&](const char *name) {
      return parameters.begin_stage ? parameters.begin_stage(name) : nullptr;
    };
    {
      const auto        stage      = begin_stage("cutting");
      OwnMeshParameters own_meshes = parameters.own_meshes;
      own_meshes.threshold         = parameters.threshold;
      meshes =
        make_own_meshes(std::move(mathematical_mesh), *blocks, own_meshes);
    }
    {
      const auto stage = begin_stage("covers");
      cover_system =
        std::make_unique<CoverSystem>(manifold_mesh(), communicator);
      // Aggregation adds the covers on which these depend.
      if (parameters.may_touch)
        cover_system->make_boundary_relevant();
      // With the threshold 0 every element is well supported, and no cover is constrained.
      aggregated =
        aggregate(*cover_system,
                  parameters.stabilization == Stabilization::aggregation
                    ? parameters.threshold
                    : 0.);
      dependence = make_constraints(*cover_system, aggregated, 2);
      if (parameters.stabilization == Stabilization::ghost_penalty)
        penalty = std::make_unique<GhostPenalty>(
          make_ghost_penalty(manifold_mesh(), parameters.threshold));
    }
    const auto stage = begin_stage("quadrature");
    degree_of_rules  = parameters.quadrature_degree > 0
                         ? parameters.quadrature_degree
                         : 2 * this->mathematical_mesh().degree();
    rules            = std::make_unique<QuadratureCollection>(
      manifold_mesh(),
      degree_of_rules,
      degree_of_rules,
      cover_system->locally_owned_elements());
  }


  Solid::Solid(Geometry                     geometry,
               const RegularMeshParameters &mesh,
               const MPI_Comm               communicator,
               const SolidParameters       &parameters)
    : Solid(std::make_shared<const PhysicalMesh>(std::move(geometry)),
            mesh,
            communicator,
            parameters)
  {
  }


  Solid::Solid(const std::shared_ptr<const PhysicalMesh> &physical_mesh,
               const RegularMeshParameters               &mesh,
               const MPI_Comm                             communicator,
               const SolidParameters                     &parameters)
    : Solid(physical_mesh,
            std::make_unique<MathematicalMesh>(
              make_regular_mesh(*physical_mesh, mesh, /* degree = */ 2)),
            communicator,
            parameters)
  {
  }


  std::pair<unsigned int, dealii::Point<2>>
  Solid::locate(const dealii::Point<2> &x) const
  {
    const unsigned int element = manifold_mesh().find_element(x);
    AssertThrow(element != invalid_index,
                InputError("the point " + to_string(x) +
                             " lies outside of the solid",
                           "Solid::locate()",
                           "give a point inside of a block"));
    return {element,
            mathematical_mesh().real_to_reference(manifold_mesh().cell(element),
                                                  x)};
  }
} // namespace NMM
