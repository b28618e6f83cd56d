#include <algorithm>
#include <mechanics/curve_conditions.h>

namespace NMM
{
  namespace internal
  {
    CurveConditions::CurveConditions(const ManifoldMesh      &mesh,
                                     const ElasticityProblem &problem)
      : curve_to_conditions(mesh.physical_mesh().curves().size())
    {
      for (unsigned int c = 0; c < problem.boundary_conditions.size(); ++c)
        for (const unsigned int curve : mesh.physical_mesh().find_curves(
               problem.boundary_conditions[c].curve))
          curve_to_conditions[curve].push_back(c);

      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        for (const ElementEdge &edge : mesh.edges(e))
          if (edge.curve_set != invalid_index)
            add_curve_set(edge.curve_set, mesh, problem);
    }


    void
    CurveConditions::add_curve_set(const unsigned int       index,
                                   const ManifoldMesh      &mesh,
                                   const ElasticityProblem &problem)
    {
      if (index >= known.size())
      {
        known.resize(index + 1, false);
        curve_set_to_tied.resize(index + 1, false);
        curve_set_to_displacement.resize(index + 1, false);
        curve_set_to_conditions.resize(index + 1);
      }
      if (known[index])
        return;
      known[index] = true;

      const PhysicalMesh        &physical_mesh = mesh.physical_mesh();
      bool                       boundary = false, open_joint = false;
      std::vector<unsigned int> &conditions = curve_set_to_conditions[index];
      for (const unsigned int piece : mesh.curve_set(index))
      {
        const unsigned int c     = physical_mesh.piece_to_curve()[piece];
        const Curve       &curve = physical_mesh.curves()[c];
        if (curve.role == CurveRole::boundary || curve.role == CurveRole::hole)
        {
          boundary = true;
          conditions.insert(conditions.end(),
                            curve_to_conditions[c].begin(),
                            curve_to_conditions[c].end());
        }
        else if (curve.role == CurveRole::joint &&
                 curve.state == JointState::open)
          open_joint = true;
      }
      std::sort(conditions.begin(), conditions.end());
      conditions.erase(std::unique(conditions.begin(), conditions.end()),
                       conditions.end());

      curve_set_to_tied[index] = !boundary && !open_joint;
      curve_set_to_displacement[index] =
        std::any_of(conditions.begin(), conditions.end(), [&](unsigned int c) {
          const auto type = problem.boundary_conditions[c].type;
          return type == BoundaryCondition::Type::displacement ||
                 type == BoundaryCondition::Type::normal_displacement;
        });
    }
  } // namespace internal
} // namespace NMM
