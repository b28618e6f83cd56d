#include <nmm/base/exceptions.h>
#include <nmm/covers/unknowns.h>
#include <nmm/covers/weight_functions.h>
#include <nmm/mechanics/joint_water_term.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace NMM
{
  using dealii::Point;
  using dealii::Tensor;

  void
  JointWater::check() const
  {
    const auto positive = [](const double value, const char *name) {
      AssertThrow(value > 0. && std::isfinite(value),
                  InputError("the " + std::string(name) + " is " +
                               std::to_string(value),
                             "the water in joints",
                             "give a positive number"));
    };
    positive(table.unit_weight, "unit weight of water [N/m^3]");
    positive(viscosity, "viscosity of water [Pa s]");
    positive(residual_aperture, "residual aperture [m]");
    positive(aperture, "aperture [m]");
    AssertThrow(largest_aperture >= aperture && aperture >= residual_aperture,
                InputError("the aperture is not between the residual and the "
                           "largest one",
                           "the water in joints",
                           "let them ascend: 'Residual aperture', 'Aperture', "
                           "'Largest aperture'"));
  }


  namespace
  {
    /// The open joint on a set of curve pieces; invalid_index if there is none, or a boundary.
    unsigned int
    open_joint(const ManifoldMesh &mesh, const unsigned int curve_set)
    {
      const PhysicalMesh &physical_mesh = mesh.physical_mesh();
      unsigned int        result        = invalid_index;
      for (const unsigned int piece : mesh.curve_set(curve_set))
      {
        const unsigned int c     = physical_mesh.piece_to_curve()[piece];
        const Curve       &curve = physical_mesh.curves()[c];
        if (curve.role == CurveRole::boundary || curve.role == CurveRole::hole)
          return invalid_index;
        if (curve.role == CurveRole::joint && curve.state == JointState::open)
          result = c;
      }
      return result;
    }


    double
    length_of(const ElementEdge &edge)
    {
      return edge.is_arc() ? std::abs(edge.radius * swept_angle(edge))
                           : edge.start.distance(edge.end);
    }
  } // namespace


  JointWaterTerm::JointWaterTerm(const Solid       &solid,
                                 const ModelLayout &layout,
                                 JointWater         water_in)
    : covers(&solid.covers())
    , layout(&layout)
    , water(std::move(water_in))
  {
    water.check();
    present.unit_weight = water.table.unit_weight;
    present.viscosity   = water.viscosity;
    find_links(solid);
    is_in_air.resize(nodes.size(), false);
    set_heads(solid);
    set_links();
    force.reinit(layout.locally_owned, layout.communicator);
  }


  /// Each link has a face on both sides. All ranks know all links.
  void
  JointWaterTerm::find_links(const Solid &solid)
  {
    const ManifoldMesh &mesh = solid.manifold_mesh();
    const auto [first, last] = covers->locally_owned_elements();
    std::map<std::pair<double, double>, unsigned int> node_at;
    const auto node = [&](const Point<2> &x) {
      const auto [place, is_new] =
        node_at.emplace(std::make_pair(x[0], x[1]), nodes.size());
      if (is_new)
      {
        nodes.push_back(x);
        present.nodes.push_back({x[1]});
      }
      return place->second;
    };
    using Key = std::tuple<unsigned int, unsigned int, unsigned int>;
    std::map<Key, unsigned int> edge_at;
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      for (const ElementEdge &edge : mesh.edges(e))
      {
        if (edge.curve_set == invalid_index || edge.neighbor == invalid_index)
          continue;
        const unsigned int joint = open_joint(mesh, edge.curve_set);
        const double       L     = length_of(edge);
        if (joint == invalid_index || !(L > 0.))
          continue;
        const unsigned int a = node(edge.start), b = node(edge.end);
        const auto [place, is_new] =
          edge_at.emplace(Key(std::min(a, b), std::max(a, b), edge.curve_set),
                          edges.size());
        if (is_new)
          edges.push_back(
            {{{a, b}, L, {0., 0.}}, mesh.physical_mesh().curves()[joint].name});
        edges[place->second].blocks.push_back(mesh.block(e));
        if (e >= first && e < last)
          add_face(place->second, e, edge);
      }
    for (const Edge &edge : edges)
      AssertThrow(edge.blocks.size() == 2,
                  InputError("the faces of joint '" + edge.joint +
                               "' are not cut by the same triangles, so that "
                               "its aperture is not known",
                             to_string(nodes[edge.link.nodes[0]]),
                             "let blocks share one mesh: 'Covers/Own meshes = "
                             "never'"));
  }


  void
  JointWaterTerm::set_links()
  {
    present.links.clear();
    names.clear();
    link_of_edge.assign(edges.size(), invalid_index);
    for (unsigned int k = 0; k < nodes.size(); ++k)
      present.nodes[k].is_in_air = is_in_air[k];
    for (unsigned int i = 0; i < edges.size(); ++i)
    {
      const Edge &edge    = edges[i];
      const auto  is_gone = [&](const unsigned int block) {
        return !absent_blocks.empty() && absent_blocks[block];
      };
      if (std::any_of(edge.blocks.begin(), edge.blocks.end(), is_gone))
      {
        for (const unsigned int node : edge.link.nodes)
          present.nodes[node].is_in_air = true;
        continue;
      }
      link_of_edge[i] = present.links.size();
      present.links.push_back(edge.link);
      names.push_back(edge.joint);
    }
  }


  void
  JointWaterTerm::set_presence(const Presence &presence)
  {
    if (presence.absent_blocks == absent_blocks)
      return;
    absent_blocks = presence.absent_blocks;
    set_links();
    // Until the flow is computed again, pressures are those before, without what has gone.
    found.flows.assign(present.links.size(), 0.);
    if (!found.heads.empty())
      assemble_force();
  }


  void
  JointWaterTerm::add_face(const unsigned int number,
                           const unsigned int element,
                           const ElementEdge &edge)
  {
    const ManifoldMesh     &mesh  = covers->manifold_mesh();
    const MathematicalMesh &cells = mesh.mathematical_mesh();
    const unsigned int      cell = mesh.cell(element), degree = cells.degree(),
                       n = cells.n_covers_per_cell();
    const EdgeRule rule =
      make_edge_rule(edge, cell_frame(mesh, element), 2 * degree);
    const auto &ends      = edges[number].link.nodes;
    const bool  is_turned = nodes[ends[0]] != edge.start;
    Face        face;
    face.edge    = number;
    face.element = element;
    double w[WeightFunctions::max_per_cell];
    for (const unsigned int end : {0u, 1u})
    {
      const bool at_start = (end == 0) != is_turned;
      WeightFunctions::values(
        degree,
        cells.real_to_reference(cell, at_start ? edge.start : edge.end),
        w);
      const Tensor<1, 2> &normal =
        at_start ? rule.normals.front() : rule.normals.back();
      face.integrals[end].resize(n);
      for (unsigned int i = 0; i < n; ++i)
        face.at_ends[end].push_back(w[i] * normal);
    }
    for (unsigned int q = 0; q < rule.points.size(); ++q)
    {
      WeightFunctions::values(degree, rule.points[q], w);
      const Point<2> x       = cells.reference_to_real(cell, rule.points[q]);
      const double   from[2] = {x.distance(nodes[ends[0]]),
                                x.distance(nodes[ends[1]])};
      for (const unsigned int end : {0u, 1u})
        for (unsigned int i = 0; i < n; ++i)
          face.integrals[end][i] -= from[1 - end] / (from[0] + from[1]) *
                                    rule.weights[q] * w[i] * rule.normals[q];
    }
    faces.push_back(std::move(face));
  }


  void
  JointWaterTerm::set_heads(const Solid &solid)
  {
    const ManifoldMesh &mesh          = solid.manifold_mesh();
    const PhysicalMesh &physical_mesh = mesh.physical_mesh();
    std::map<std::pair<double, double>, unsigned int> node_at;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      node_at[{nodes[k][0], nodes[k][1]}] = k;
    const auto set_head = [&](const Point<2> &x, const CurveRole role) {
      const auto place = node_at.find({x[0], x[1]});
      if (place == node_at.end())
        return;
      FlowNetwork::Node &node  = present.nodes[place->second];
      const double       level = water.table.elevation(x[0]);
      if (role == CurveRole::boundary && level >= x[1])
        node.head = level;
      else
        is_in_air[place->second] = true;
    };
    for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      for (const ElementEdge &edge : mesh.edges(e))
      {
        if (edge.curve_set == invalid_index || edge.neighbor != invalid_index)
          continue;
        for (const unsigned int piece : mesh.curve_set(edge.curve_set))
        {
          const Curve &curve =
            physical_mesh.curves()[physical_mesh.piece_to_curve()[piece]];
          if ((curve.role != CurveRole::boundary &&
               curve.role != CurveRole::hole) ||
              std::find(water.impermeable.begin(),
                        water.impermeable.end(),
                        curve.name) != water.impermeable.end())
            continue;
          set_head(edge.start, curve.role);
          set_head(edge.end, curve.role);
        }
      }
  }


  double
  JointWaterTerm::amplitude(const double t) const
  {
    return water.amplitude ? water.amplitude(t) : 1.;
  }


  double
  JointWaterTerm::pressure(const unsigned int node) const
  {
    return present.unit_weight *
           std::max(0., found.heads[node] - present.nodes[node].elevation);
  }


  void
  JointWaterTerm::update(const Vector &u)
  {
    std::vector<dealii::types::global_dof_index> dofs;
    std::vector<double> openings(2 * present.links.size(), 0.);
    for (const Face &face : faces)
    {
      const unsigned int link = link_of_edge[face.edge];
      if (link == invalid_index)
        continue;
      covers->get_dof_indices(face.element, 2, dofs);
      for (const unsigned int end : {0u, 1u})
        for (unsigned int i = 0; i < face.at_ends[end].size(); ++i)
          for (unsigned int c = 0; c < 2; ++c)
            openings[2 * link + end] -=
              face.at_ends[end][i][c] * u(dofs[unknown_of(i, c)]);
    }
    dealii::Utilities::MPI::sum(openings, layout->communicator, openings);
    for (unsigned int l = 0; l < present.links.size(); ++l)
      for (const unsigned int end : {0u, 1u})
        present.links[l].apertures[end] =
          std::min(water.largest_aperture,
                   std::max(water.residual_aperture,
                            water.aperture + openings[2 * l + end]));

    std::vector<double> before(nodes.size(), 0.);
    for (unsigned int k = 0; k < found.heads.size(); ++k)
      before[k] = pressure(k);
    found       = solve_flow(present);
    last_change = 0.;
    for (unsigned int k = 0; k < nodes.size(); ++k)
      last_change = std::max(last_change, std::abs(pressure(k) - before[k]));
    assemble_force();
  }


  void
  JointWaterTerm::assemble_force()
  {
    std::vector<dealii::types::global_dof_index> dofs;
    dealii::Vector<double>                       local;
    force = 0.;
    for (const Face &face : faces)
    {
      const unsigned int link = link_of_edge[face.edge];
      if (link == invalid_index)
        continue;
      covers->get_dof_indices(face.element, 2, dofs);
      local.reinit(dofs.size());
      for (const unsigned int end : {0u, 1u})
        for (unsigned int i = 0; i < face.integrals[end].size(); ++i)
          for (unsigned int c = 0; c < 2; ++c)
            local[unknown_of(i, c)] +=
              pressure(present.links[link].nodes[end]) *
              face.integrals[end][i][c];
      layout->constraints->distribute_local_to_global(local, dofs, force);
    }
    force.compress(dealii::VectorOperation::add);
  }


  void
  JointWaterTerm::begin_step(const StepBegin &step)
  {
    update(step.u);
  }


  Deformation
  JointWaterTerm::assemble(const Trial &trial, AssembledForces &sum)
  {
    const double factor = amplitude(trial.end_time);
    sum.residual->add(-factor, force);
    const double norm = factor * force.l2_norm();
    sum.scale         = std::sqrt(sum.scale * sum.scale + norm * norm);
    return Deformation::admissible;
  }


  StepWork
  JointWaterTerm::commit(const Trial &step)
  {
    StepWork work;
    if (step.begin == nullptr)
      return work;
    double sum = 0.;
    for (const auto i : layout->locally_owned)
      sum += force(i) * ((*step.end)(i) - (*step.begin)(i));
    work.loads = amplitude(step.end_time) *
                 dealii::Utilities::MPI::sum(sum, layout->communicator);
    return work;
  }
} // namespace NMM
