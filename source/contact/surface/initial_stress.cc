// The initial stress at faces that touch each other in the reference configuration.
#include <nmm/contact/surface/initial_stress.h>
#include <nmm/geometry/physical_mesh.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <contact/detection/points.h>
#include <limits>
#include <map>
#include <utility>

namespace NMM
{
  using dealii::Point;
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  namespace
  {
    using BoostPoint = boost::geometry::model::d2::point_xy<double>;
    using BoostBox   = boost::geometry::model::box<BoostPoint>;
    using TreeValue  = std::pair<BoostBox, unsigned int>;
    using Tree =
      boost::geometry::index::rtree<TreeValue,
                                    boost::geometry::index::quadratic<16>>;


    /// A box with the edge in the reference configuration. An arc of at most a half circle reaches
    /// at most half of its length beyond its chord.
    BoostBox
    box_of(const ContactSurface::Edge &edge)
    {
      const double more = edge.radius == 0. ? 0. : 0.5 * edge.length;
      return BoostBox({std::min(edge.start[0], edge.end[0]) - more,
                       std::min(edge.start[1], edge.end[1]) - more},
                      {std::max(edge.start[0], edge.end[0]) + more,
                       std::max(edge.start[1], edge.end[1]) + more});
    }


    /// For each edge of a block, the edge that touches its middle in the reference configuration, or
    /// invalid_index.
    std::vector<unsigned int>
    find_mates(const ContactSurface &surface)
    {
      // Fraction of the length of an edge within which others touch it.
      constexpr double touching = 1e-6;
      // Cosine: faces that touch are opposite to each other.
      constexpr double opposite = -0.99;

      const auto            &edges = surface.edges();
      std::vector<TreeValue> values;
      for (unsigned int e = 0; e < edges.size(); ++e)
        values.emplace_back(box_of(edges[e]), e);
      const Tree                tree(values);
      std::vector<unsigned int> result(edges.size(), invalid_index);
      std::vector<TreeValue>    near;
      for (unsigned int e = 0; e < edges.size(); ++e)
      {
        if (surface.is_rigid(e))
          continue;
        const ContactSurface::Place here  = surface.reference_place(e, 0.5);
        double                      least = touching * edges[e].length;
        near.clear();
        tree.query(boost::geometry::index::intersects(
                     BoostBox({here.x[0] - least, here.x[1] - least},
                              {here.x[0] + least, here.x[1] + least})),
                   std::back_inserter(near));
        for (const TreeValue &value : near)
        {
          const unsigned int          f     = value.second;
          const ContactSurface::Place there = surface.reference_place(
            f, internal::nearest_parameter(edges[f], here.x));
          const double distance = here.x.distance(there.x);
          if (f != e && distance <= least &&
              here.normal() * there.normal() < opposite)
          {
            least     = distance;
            result[e] = f;
          }
        }
      }
      return result;
    }
  } // namespace


  std::vector<InitialFaceStress>
  initial_stress_at_faces(const ContactSurface    &surface,
                          const ElasticityProblem &problem)
  {
    if (std::all_of(problem.materials.begin(),
                    problem.materials.end(),
                    [](const Material &material) {
                      return !material.has_initial_stress();
                    }))
      return {};
    const ManifoldMesh &mesh = surface.cover_system().manifold_mesh();
    const std::vector<unsigned int> region_to_material =
      problem.region_to_material(mesh.physical_mesh());
    const auto &edges    = surface.edges();
    const auto  material = [&](const unsigned int e) -> const Material  &{
      return problem
        .materials[region_to_material[mesh.region(edges[e].element)]];
    };
    const std::vector<unsigned int> mates = find_mates(surface);
    std::vector<InitialFaceStress>  result(edges.size());
    for (unsigned int e = 0; e < edges.size(); ++e)
      if (mates[e] != invalid_index)
      {
        const Material &here = material(e), &there = surface.is_rigid(mates[e])
                                                       ? here
                                                       : material(mates[e]);
        result[e] = {mates[e],
                     0.5 * (here.initial_stress + there.initial_stress),
                     {{here.varying_initial_stress,
                       there.varying_initial_stress}}};
      }
    return result;
  }


  std::vector<ExceededStrength>
  find_exceeded_strength(const ContactSurface    &surface,
                         const ContactParameters &parameters)
  {
    // Fraction of the stress, for rounding.
    constexpr double rounding = 1e-9;

    if (parameters.initial_stress.empty())
      return {};
    const internal::ContactLaws laws(surface, parameters);
    std::map<std::pair<std::string, std::string>, ExceededStrength> found;
    for (unsigned int e = 0; e < parameters.initial_stress.size(); ++e)
    {
      const unsigned int          mate  = parameters.initial_stress[e].mate;
      const ContactSurface::Place place = surface.reference_place(e, 0.5);
      const SymmetricTensor<2, 2> stress =
        parameters.initial_stress[e].at(place.x);
      if (mate == invalid_index || stress.norm() == 0.)
        continue;
      const Tensor<1, 2> normal = place.normal();
      const ContactLaw  &law    = laws(e, mate);
      ExceededStrength   here;
      here.place    = place.x;
      here.pressure = -(normal * (stress * normal));
      here.shear    = std::abs(place.a * (stress * normal)) / place.a.norm();
      const double pressure = std::max(0., here.pressure);
      here.strength         = law.is_bond ? law.bond_strength(pressure)
                                          : law.strength(pressure, 0.).value;
      if (here.shear - here.strength <= rounding * stress.norm() &&
          -here.pressure <= (law.is_bond ? law.tensile_strength : 0.) +
                              rounding * stress.norm())
        continue;
      // Both faces of a joint are here, each with its length.
      here.length =
        (surface.is_rigid(mate) ? 1. : 0.5) * surface.edges()[e].length;
      here.first               = std::min(surface.name(e), surface.name(mate));
      here.second              = std::max(surface.name(e), surface.name(mate));
      ExceededStrength &known  = found[{here.first, here.second}];
      const double      length = known.length + here.length;
      if (known.length == 0. || here.excess() > known.excess())
        known = here;
      known.length = length;
    }
    std::vector<ExceededStrength> result;
    for (const auto &entry : found)
      result.push_back(entry.second);
    return result;
  }
} // namespace NMM
