#include <algorithm>
#include <cmath>
#include <mechanics/edge_tables.h>

namespace NMM
{
  namespace internal
  {
    using Type = BoundaryCondition::Type;


    EdgeTables::EdgeTables(const CoverSystem       &covers,
                           const ElasticityProblem &problem,
                           const CurveConditions   &curve_conditions,
                           TraceConstants          &trace_constants)
      : covers(&covers)
      , problem(&problem)
      , maker(covers, problem, trace_constants)
      , degree(covers.manifold_mesh().mathematical_mesh().degree())
      , n_per_cell(WeightFunctions::n_per_cell(degree))
    {
      const auto [first, last] = covers.locally_owned_elements();
      for (unsigned int e = first; e < last; ++e)
        add_conditions(e, curve_conditions);
      for_each_tie(covers,
                   curve_conditions,
                   [&](const unsigned int e, const ElementEdge &edge) {
                     add_tie(e, edge);
                   });
    }


    void
    EdgeTables::add_conditions(const unsigned int     element,
                               const CurveConditions &curve_conditions)
    {
      const ManifoldMesh &mesh = covers->manifold_mesh();
      Site                weak{element, invalid_index, 0, 0}, follower = weak;
      weak.first_point     = weak_points.size();
      follower.first_point = follower_points.size();
      for (const ElementEdge &edge : mesh.edges(element))
      {
        const std::vector<unsigned int> &on_edge =
          curve_conditions.conditions(element, edge);
        if (on_edge.empty())
          continue;
        const EdgeRule rule =
          make_edge_rule(edge, cell_frame(mesh, element), 2 * degree);
        for (const unsigned int c : on_edge)
        {
          if (problem->boundary_conditions[c].type == Type::follower_pressure)
            add_follower(c, element, rule);
          else if (problem->boundary_conditions[c].is_support())
          {
            maker.append_condition(c, element, rule, weak_points);
            append_places(element, rule);
          }
        }
      }
      weak.last_point     = weak_points.size();
      follower.last_point = follower_points.size();
      if (weak.last_point > weak.first_point)
        conditions.push_back(weak);
      if (follower.last_point > follower.first_point)
        followers.push_back(follower);
    }


    void
    EdgeTables::add_follower(const unsigned int condition,
                             const unsigned int element,
                             const EdgeRule    &rule)
    {
      const BoundaryCondition &c = problem->boundary_conditions[condition];
      if (c.value == nullptr)
        return;
      const ManifoldMesh        &mesh = covers->manifold_mesh();
      const unsigned int         cell = mesh.cell(element);
      const dealii::Tensor<2, 2> T    = dealii::transpose(
        dealii::invert(mesh.mathematical_mesh().jacobian(cell)));
      double g[WeightFunctions::max_per_cell][2];
      for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        FollowerPoint point;
        point.condition = condition;
        point.weighted_pressure =
          rule.weights[q] *
          c.value->value(
            mesh.mathematical_mesh().reference_to_real(cell, rule.points[q]));
        WeightFunctions::values(degree, rule.points[q], point.values);
        WeightFunctions::gradients(degree, rule.points[q], g);
        point.tangent[0]             = -rule.normals[q][1];
        point.tangent[1]             = rule.normals[q][0];
        const dealii::Tensor<1, 2> t = dealii::transpose(T) * point.tangent;
        for (unsigned int i = 0; i < n_per_cell; ++i)
          point.tangential[i] = t[0] * g[i][0] + t[1] * g[i][1];
        follower_points.push_back(point);
      }
    }


    void
    EdgeTables::add_tie(const unsigned int element, const ElementEdge &edge)
    {
      const ManifoldMesh &mesh = covers->manifold_mesh();
      Site                site{element, edge.neighbor, 0, 0};
      site.first_point = weak_points.size();
      const EdgeRule rule =
        make_edge_rule(edge, cell_frame(mesh, element), 2 * degree);
      maker.append_tie(element, edge, rule, weak_points);
      append_places(element, rule);
      site.last_point = weak_points.size();
      if (site.last_point > site.first_point)
        ties.push_back(site);
    }


    /// There are as many new points as the rule has, or none.
    void
    EdgeTables::append_places(const unsigned int element, const EdgeRule &rule)
    {
      if (!problem->has_varying_initial_stress())
        return;
      const ManifoldMesh &mesh = covers->manifold_mesh();
      for (const dealii::Point<2> &xi : rule.points)
        if (places.size() < weak_points.size())
          places.push_back(
            mesh.mathematical_mesh().reference_to_real(mesh.cell(element), xi));
      AssertDimension(places.size(), weak_points.size());
    }


    /// Sums the forces of a load on each cover.
    class DeadLoads::Collector
    {
    public:
      explicit Collector(const unsigned int n_covers)
        : cover_to_entry(n_covers, invalid_index)
      {
      }

      void
      add(const unsigned int          cover,
          const double                weight,
          const dealii::Tensor<1, 2> &force)
      {
        if (cover_to_entry[cover] == invalid_index)
        {
          cover_to_entry[cover] = load.covers.size();
          load.covers.push_back(cover);
          load.forces.emplace_back();
        }
        load.forces[cover_to_entry[cover]] += weight * force;
      }

      /// Return the forces collected so far, and begin the next load.
      Load
      take()
      {
        for (const unsigned int k : load.covers)
          cover_to_entry[k] = invalid_index;
        Load result;
        std::swap(result, load);
        return result;
      }

    private:
      std::vector<unsigned int> cover_to_entry;
      Load                      load;
    };


    DeadLoads::DeadLoads(const CoverSystem          &covers,
                         const QuadratureCollection &quadrature,
                         const ElasticityProblem    &problem,
                         const CurveConditions      &conditions,
                         const PointTerms           &points)
      : boundary_conditions(problem.boundary_conditions.size())
      , point_forces(problem.point_forces.size())
      , covers(&covers)
      , problem(&problem)
      , degree(covers.manifold_mesh().mathematical_mesh().degree())
      , n_per_cell(WeightFunctions::n_per_cell(degree))
    {
      if (problem.body_force != nullptr || problem.gravity.norm() > 0. ||
          problem.has_forces_of_materials())
        add_volume_loads(quadrature);
      add_tractions(conditions);
      add_point_forces(points.point_force_elements());
    }


    void
    DeadLoads::add_volume_loads(const QuadratureCollection &quadrature)
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const auto              region_to_material =
        problem->region_to_material(mesh.physical_mesh());
      const bool has_gravity =
        problem->gravity.norm() > 0. || problem->has_forces_of_materials();

      Collector gravity_load(has_gravity ? covers->n_covers() : 0),
        other_load(problem->body_force != nullptr ? covers->n_covers() : 0);
      double w[WeightFunctions::max_per_cell];
      const auto [first, last] = covers->locally_owned_elements();
      for (unsigned int e = first; e < last; ++e)
      {
        const unsigned int cell = mesh.cell(e);
        const double       det =
          dealii::determinant(mathematical_mesh.jacobian(cell));
        const Material &material =
          problem->materials[region_to_material[mesh.region(e)]];
        const dealii::Quadrature<2> &rule = quadrature.rule(e);
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          WeightFunctions::values(degree, rule.point(q), w);
          const dealii::Point<2> x =
            mathematical_mesh.reference_to_real(cell, rule.point(q));
          const dealii::Tensor<1, 2> weight =
            material.weight_at(x, problem->gravity);
          dealii::Tensor<1, 2> f;
          if (problem->body_force != nullptr)
            for (unsigned int c = 0; c < 2; ++c)
              f[c] = problem->body_force->value(x, c);
          for (unsigned int i = 0; i < n_per_cell; ++i)
          {
            const unsigned int k      = covers->covers(e)[i];
            const double       factor = det * rule.weight(q) * w[i];
            if (has_gravity)
              gravity_load.add(k, factor, weight);
            if (problem->body_force != nullptr)
              other_load.add(k, factor, f);
          }
        }
      }
      gravity    = gravity_load.take();
      body_force = other_load.take();
    }


    void
    DeadLoads::add_tractions(const CurveConditions &conditions)
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      Collector               collector(covers->n_covers());
      double                  w[WeightFunctions::max_per_cell];
      const auto [first, last] = covers->locally_owned_elements();
      for (unsigned int c = 0; c < problem->boundary_conditions.size(); ++c)
      {
        const BoundaryCondition &condition = problem->boundary_conditions[c];
        if (condition.value == nullptr || condition.is_support() ||
            condition.type == Type::follower_pressure)
          continue;
        for (unsigned int e = first; e < last; ++e)
          for (const ElementEdge &edge : mesh.edges(e))
          {
            const std::vector<unsigned int> &on_edge =
              conditions.conditions(e, edge);
            if (std::find(on_edge.begin(), on_edge.end(), c) == on_edge.end())
              continue;
            const unsigned int cell = mesh.cell(e);
            const EdgeRule     rule =
              make_edge_rule(edge, cell_frame(mesh, e), 2 * degree);
            for (unsigned int q = 0; q < rule.points.size(); ++q)
            {
              const dealii::Point<2> x =
                mathematical_mesh.reference_to_real(cell, rule.points[q]);
              dealii::Tensor<1, 2> t;
              if (condition.type != Type::traction)
                t = -condition.value->value(x) * rule.normals[q];
              else
                for (unsigned int d = 0; d < 2; ++d)
                  t[d] = condition.value->value(x, d);
              WeightFunctions::values(degree, rule.points[q], w);
              for (unsigned int i = 0; i < n_per_cell; ++i)
                collector.add(covers->covers(e)[i], rule.weights[q] * w[i], t);
            }
          }
        boundary_conditions[c] = collector.take();
      }
    }


    void
    DeadLoads::add_point_forces(const std::vector<unsigned int> &elements)
    {
      const ManifoldMesh     &mesh              = covers->manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      double                  w[WeightFunctions::max_per_cell];
      const auto [first, last] = covers->locally_owned_elements();
      Collector collector(elements.empty() ? 0 : covers->n_covers());
      for (unsigned int f = 0; f < elements.size(); ++f)
      {
        const PointForce  &force = problem->point_forces[f];
        const unsigned int e     = elements[f];
        if (e < first || e >= last)
          continue;
        WeightFunctions::values(
          degree,
          mathematical_mesh.real_to_reference(mesh.cell(e), force.point),
          w);
        for (unsigned int i = 0; i < n_per_cell; ++i)
          collector.add(covers->covers(e)[i], w[i], force.force);
        point_forces[f] = collector.take();
      }
    }
  } // namespace internal
} // namespace NMM
