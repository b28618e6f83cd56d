#include <algorithm>
#include <mechanics/curve_conditions.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      bool
      is_open_joint(const Curve &curve)
      {
        return curve.role == CurveRole::joint &&
               curve.state == JointState::open;
      }


      bool
      is_boundary(const Curve &curve)
      {
        return curve.role == CurveRole::boundary ||
               curve.role == CurveRole::hole;
      }
    } // namespace


    CurveConditions::CurveConditions(const ManifoldMesh      &mesh,
                                     const ElasticityProblem &problem)
      : mesh(&mesh)
    {
      const PhysicalMesh &physical_mesh = mesh.physical_mesh();
      std::vector<std::vector<unsigned int>> curve_to_conditions(
        physical_mesh.curves().size());
      for (unsigned int c = 0; c < problem.boundary_conditions.size(); ++c)
        for (const unsigned int curve :
             problem.boundary_conditions[c].curves_in(physical_mesh))
          curve_to_conditions[curve].push_back(c);

      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        for (const ElementEdge &edge : mesh.edges(e))
          if (edge.curve_set != invalid_index)
          {
            add_curve_set(edge.curve_set, curve_to_conditions);
            const std::pair<unsigned int, unsigned int> key(edge.curve_set,
                                                            mesh.region(e));
            if (curve_set_has_conditions[edge.curve_set] &&
                faces.find(key) == faces.end())
              faces[key] = make_face(edge.curve_set,
                                     mesh.region(e),
                                     problem,
                                     curve_to_conditions);
          }
    }


    const CurveConditions::Face &
    CurveConditions::face(const unsigned int element,
                          const ElementEdge &edge) const
    {
      if (edge.curve_set == invalid_index ||
          !curve_set_has_conditions[edge.curve_set])
        return free;
      return faces.at({edge.curve_set, mesh->region(element)});
    }


    void
    CurveConditions::add_curve_set(
      const unsigned int                            index,
      const std::vector<std::vector<unsigned int>> &curve_to_conditions)
    {
      if (index >= known.size())
      {
        known.resize(index + 1, false);
        curve_set_to_tied.resize(index + 1, false);
        curve_set_has_conditions.resize(index + 1, false);
      }
      if (known[index])
        return;
      known[index] = true;

      const PhysicalMesh &physical_mesh = mesh->physical_mesh();
      bool                boundary = false, open_joint = false;
      for (const unsigned int piece : mesh->curve_set(index))
      {
        const unsigned int c     = physical_mesh.piece_to_curve()[piece];
        const Curve       &curve = physical_mesh.curves()[c];
        if (is_boundary(curve))
        {
          boundary = true;
          if (!curve_to_conditions[c].empty())
            curve_set_has_conditions[index] = true;
        }
        else if (is_open_joint(curve))
        {
          open_joint = true;
          if (!curve_to_conditions[c].empty())
            curve_set_has_conditions[index] = true;
        }
      }
      curve_set_to_tied[index] = !boundary && !open_joint;
    }


    CurveConditions::Face
    CurveConditions::make_face(
      const unsigned int                            index,
      const unsigned int                            region,
      const ElasticityProblem                      &problem,
      const std::vector<std::vector<unsigned int>> &curve_to_conditions) const
    {
      const PhysicalMesh              &physical_mesh = mesh->physical_mesh();
      const std::vector<unsigned int> &pieces        = mesh->curve_set(index);
      const auto curve_of = [&](const unsigned int piece) {
        return physical_mesh.piece_to_curve()[piece];
      };
      const bool is_at_boundary =
        std::any_of(pieces.begin(), pieces.end(), [&](const unsigned int p) {
          return is_boundary(physical_mesh.curves()[curve_of(p)]);
        });
      Face                       result;
      std::vector<unsigned int> &conditions = result.conditions;
      for (const unsigned int piece : pieces)
      {
        const unsigned int c     = curve_of(piece);
        const Curve       &curve = physical_mesh.curves()[c];
        if (is_at_boundary
              ? is_boundary(curve) && physical_mesh.is_face_of(c, region)
              : is_open_joint(curve))
          conditions.insert(conditions.end(),
                            curve_to_conditions[c].begin(),
                            curve_to_conditions[c].end());
      }
      std::sort(conditions.begin(), conditions.end());
      conditions.erase(std::unique(conditions.begin(), conditions.end()),
                       conditions.end());
      result.has_displacement =
        std::any_of(conditions.begin(), conditions.end(), [&](unsigned int c) {
          return problem.boundary_conditions[c].is_support();
        });
      return result;
    }
  } // namespace internal
} // namespace NMM
