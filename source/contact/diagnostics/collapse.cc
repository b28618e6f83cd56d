#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <base/cross.h>
#include <cmath>
#include <contact/detection/points.h>
#include <contact/diagnostics/collapse.h>
#include <limits>
#include <mechanics/curve_conditions.h>
#include <mechanics/point_terms.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;
    using Rigid = RigidBlocks::Rigid;

    namespace
    {
      double
      product(const Rigid &a, const Rigid &b)
      {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      }


      /// The force and moment about @p center of a unit force along @p direction at @p place.
      Rigid
      unit_force(const Point<2>     &center,
                 const Point<2>     &place,
                 const Tensor<1, 2> &direction)
      {
        return {{direction[0], direction[1], cross(place - center, direction)}};
      }
    } // namespace


    RigidBlocks::RigidBlocks(const std::vector<BlockMotion> &blocks)
      : blocks(blocks)
    {
      for (const BlockMotion &block : blocks)
      {
        const double by_mass = block.area > 0. ? 1. / block.area : 0.;
        inverse_masses.push_back(
          {{by_mass,
            by_mass,
            block.radius > 0. ? by_mass / (block.radius * block.radius) : 0.}});
      }
    }


    void
    RigidBlocks::add_force(const unsigned int  first,
                           const unsigned int  second,
                           const Point<2>     &place,
                           const Tensor<1, 2> &direction,
                           const double        least,
                           const double        most)
    {
      Force force{first, second, {}, {}, least, most, 0.};
      for (const auto &[block, sign, on] :
           {std::make_tuple(first, 1., &force.on_first),
            std::make_tuple(second, -1., &force.on_second)})
        if (block != invalid_index)
        {
          *on = unit_force(blocks[block].center, place, sign * direction);
          for (unsigned int i = 0; i < 3; ++i)
            force.inverse_mass +=
              (*on)[i] * (*on)[i] * inverse_masses[block][i];
        }
      if (force.inverse_mass > 0.)
        forces.push_back(force);
    }


    std::vector<Rigid>
    RigidBlocks::find_mechanism(const std::vector<Rigid> &loads) const
    {
      // Iterations through all forces, the change of the motion in one of them at which they end,
      // and the motion that counts, relative to that without forces (in the norm of the masses).
      constexpr unsigned int max_sweeps = 20000;
      constexpr double       settled = 1e-8, least_motion = 1e-4;

      std::vector<Rigid> v(loads);
      double             scale = 0.;
      for (unsigned int b = 0; b < v.size(); ++b)
        for (unsigned int i = 0; i < 3; ++i)
        {
          v[b][i] *= inverse_masses[b][i];
          scale += v[b][i] * loads[b][i];
        }
      std::vector<double> sizes(forces.size(), 0.);
      for (unsigned int sweep = 0; sweep < max_sweeps; ++sweep)
      {
        double change = 0.;
        for (unsigned int f = 0; f < forces.size(); ++f)
        {
          const Force &force = forces[f];
          double       speed = 0.;
          if (force.first != invalid_index)
            speed += product(force.on_first, v[force.first]);
          if (force.second != invalid_index)
            speed += product(force.on_second, v[force.second]);
          const double size = std::clamp(sizes[f] - speed / force.inverse_mass,
                                         force.least,
                                         force.most);
          const double more = size - sizes[f];
          sizes[f]          = size;
          change += more * more * force.inverse_mass;
          for (const auto &[block, on] :
               {std::make_pair(force.first, &force.on_first),
                std::make_pair(force.second, &force.on_second)})
            if (block != invalid_index && more != 0.)
              for (unsigned int i = 0; i < 3; ++i)
                v[block][i] += more * (*on)[i] * inverse_masses[block][i];
        }
        if (change <= settled * settled * scale)
          break;
      }
      double motion = 0., power = 0.;
      for (unsigned int b = 0; b < v.size(); ++b)
      {
        power += product(v[b], loads[b]);
        for (unsigned int i = 0; i < 3; ++i)
          if (inverse_masses[b][i] > 0.)
            motion += v[b][i] * v[b][i] / inverse_masses[b][i];
      }
      return power > 0. && motion > least_motion * least_motion * scale
               ? v
               : std::vector<Rigid>();
    }


    namespace
    {
      /// Generalized forces on the blocks of the @p forces on owned unknowns.
      std::vector<Rigid>
      forces_on_blocks(const CoverSystem              &covers,
                       const std::vector<BlockMotion> &blocks,
                       const SolidTerm::Vector        &forces)
      {
        const ManifoldMesh       &mesh = covers.manifold_mesh();
        std::vector<unsigned int> cover_to_block(covers.n_covers(), 0);
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
          for (const unsigned int cover : covers.covers(e))
            cover_to_block[cover] = mesh.block(e);
        std::vector<Rigid> result(blocks.size(), Rigid{});
        for (const auto k : covers.locally_owned_covers())
        {
          const Tensor<1, 2> force(
            {forces(unknown_of(k, 0)), forces(unknown_of(k, 1))});
          const unsigned int block = cover_to_block[k];
          const Rigid        one =
            unit_force(blocks[block].center, covers.node(k), force);
          for (unsigned int i = 0; i < 3; ++i)
            result[block][i] += one[i];
        }
        return result;
      }


      /// Add what holds blocks in both directions: displacement conditions, ties, fixed points.
      void
      add_supports(const CoverSystem       &covers,
                   const ElasticityProblem &problem,
                   RigidBlocks             &rigid)
      {
        constexpr double      any  = std::numeric_limits<double>::max();
        const ManifoldMesh   &mesh = covers.manifold_mesh();
        const CurveConditions conditions(mesh, problem);
        const PointTerms      points(covers, problem);
        const auto            hold = [&](const unsigned int  block,
                              const unsigned int  other,
                              const Point<2>     &x,
                              const Tensor<1, 2> &direction) {
          rigid.add_force(block, other, x, direction, -any, any);
        };
        for (unsigned int e = 0; e < mesh.n_elements(); ++e)
          for (const ElementEdge &edge : mesh.edges(e))
          {
            const bool is_tie = conditions.is_tied(e, edge) &&
                                e < edge.neighbor &&
                                mesh.block(e) != mesh.block(edge.neighbor);
            if (!is_tie && !conditions.has_displacement(e, edge))
              continue;
            const EdgeRule rule = make_edge_rule(edge, cell_frame(mesh, e), 2);
            for (unsigned int q = 0; q < rule.points.size(); ++q)
            {
              const Point<2> x =
                mesh.mathematical_mesh().reference_to_real(mesh.cell(e),
                                                           rule.points[q]);
              for (unsigned int d = 0; is_tie && d < 2; ++d)
                hold(mesh.block(e),
                     mesh.block(edge.neighbor),
                     x,
                     Point<2>::unit_vector(d));
              for (const unsigned int c : conditions.conditions(e, edge))
              {
                const BoundaryCondition &condition =
                  problem.boundary_conditions[c];
                if (condition.holds_normal())
                  hold(mesh.block(e), invalid_index, x, rule.normals[q]);
                else if (condition.is_support())
                  for (unsigned int d = 0; d < 2; ++d)
                    if (condition.components[d])
                      hold(mesh.block(e),
                           invalid_index,
                           x,
                           Point<2>::unit_vector(d));
              }
            }
          }
        for (unsigned int f = 0; f < problem.fixed_points.size(); ++f)
          for (unsigned int d = 0; d < 2; ++d)
            if (problem.fixed_points[f].components[d])
              hold(mesh.block(points.fixed_point_elements()[f]),
                   invalid_index,
                   problem.fixed_points[f].point,
                   Point<2>::unit_vector(d));
      }


      /// Add the forces of contact points that touch or nearly touch: pressure, friction in
      /// proportion to it, cohesion and the tension of bonds.
      void
      add_contact(const Contact &contact, RigidBlocks &rigid)
      {
        // Part of the reach: faces that have parted less are not yet out of contact, since elastic
        // blocks bend.
        constexpr double near = 0.1;
        constexpr double any  = std::numeric_limits<double>::max();

        const ContactSurface &surface = contact.surface();
        const ContactLaws     laws(surface, contact.parameters());
        const unsigned int    n_blocks =
          surface.n_bodies() - surface.obstacles().size();
        double pressure = 0., weight = 0.;
        for (const ContactPoint &point : contact.points())
          if (point.pressure > 0.)
          {
            pressure += point.weight * point.pressure;
            weight += point.weight;
          }
        const auto block_of = [&](const unsigned int edge) {
          const unsigned int body = surface.edges()[edge].body;
          return body < n_blocks ? body : invalid_index;
        };
        for (const ContactPoint &point : contact.points())
        {
          if (point.master == invalid_index || point.weight == 0. ||
              point.gap > near * contact.parameters().reach)
            continue;
          const ContactLaw &law = laws(point.edge, point.master);
          const double      at  = point.pressure > 0. || weight == 0.
                                    ? point.pressure
                                    : pressure / weight;
          // The tangent bounds a strength that is concave in the pressure.
          const auto   strength = law.strength(std::max(0., at), 0.);
          const double cohesion =
            std::max(point.is_bonded ? law.bond_strength(0.) : 0.,
                     strength.value - strength.by_pressure * std::max(0., at));
          const double       friction = strength.by_pressure;
          const Tensor<1, 2> n = point.normal, along = Point<2>(-n[1], n[0]);
          const unsigned int first  = block_of(point.edge),
                             second = block_of(point.master);
          const double size         = std::hypot(1., friction);
          for (const double sign : {-1., 1.})
            rigid.add_force(first,
                            second,
                            point.x,
                            (n + sign * friction * along) / size,
                            0.,
                            any);
          const double most = point.weight * cohesion;
          if (most > 0.)
            rigid.add_force(first, second, point.x, along, -most, most);
          if (point.is_bonded)
            rigid.add_force(first,
                            second,
                            point.x,
                            n,
                            -point.weight * law.tensile_strength,
                            0.);
        }
      }
    } // namespace


    std::vector<BlockMotion>
    find_collapse(SolidTerm                      &solid,
                  Contact                        &contact,
                  const SolidTerm::Vector        &u,
                  const std::vector<BlockMotion> &blocks,
                  const double                    factor)
    {
      const CoverSystem &covers = solid.elasticity().cover_system();
      if (dealii::Utilities::MPI::n_mpi_processes(covers.communicator()) > 1)
        return {};
      // The loads are proportional to the load factor.
      SolidTerm::Vector loads = solid.residual_at(u, 0.);
      loads.add(-1., solid.residual_at(u, factor));
      contact.detect(u);
      if (!contact.is_idle())
        contact.assemble(u, /* with_tangent = */ false);

      RigidBlocks rigid(blocks);
      add_supports(covers, solid.elasticity().elasticity_problem(), rigid);
      if (!contact.is_idle())
        add_contact(contact, rigid);
      const std::vector<Rigid> v =
        rigid.find_mechanism(forces_on_blocks(covers, blocks, loads));
      std::vector<BlockMotion> result;
      for (unsigned int b = 0; b < v.size(); ++b)
      {
        result.push_back(blocks[b]);
        result.back().translation = Point<2>(v[b][0], v[b][1]);
        result.back().rotation    = v[b][2];
      }
      return result;
    }
  } // namespace internal
} // namespace NMM
