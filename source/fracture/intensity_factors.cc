#include <nmm/base/exceptions.h>
#include <nmm/fracture/intensity_factors.h>
#include <nmm/fracture/tip_field.h>
#include <nmm/quadrature/element_rule_builder.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace NMM
{
  namespace
  {
    using dealii::Point;
    using dealii::SymmetricTensor;
    using dealii::Tensor;

    constexpr unsigned int rule_degree = 10;

    /// Inner radius, where q begins to decrease, over the outer radius [-]. A smaller value makes q
    /// smoother; a larger one leaves out more of the region at the tip, where the solution is least
    /// accurate.
    constexpr double plateau = 0.2;

    /// Radius within which the contact traction is taken to be uniform, over that of a disk [-].
    constexpr double near_tip = 0.2;


    /// The function q(r) of a disk with the radius @p outer, and its derivative dq/dr [1/m].
    std::pair<double, double>
    cut_off(const double r, const double outer)
    {
      const double width = (1. - plateau) * outer;
      const double t     = std::min(1., std::max(0., (outer - r) / width));
      return {t * t * t * t * (35. + t * (-84. + t * (70. - 20. * t))),
              -140. * std::pow(t * (1. - t), 3) / width};
    }


    /// A point x(t) of an edge of an element, with t in [0, 1] from its start.
    struct EdgePoint
    {
      Point<2> x;
      /// Derivative dx/dt [m].
      Tensor<1, 2> velocity;
    };


    EdgePoint
    point_on(const ElementEdge &edge, const double t)
    {
      if (!edge.is_arc())
        return {edge.start + t * (edge.end - edge.start),
                edge.end - edge.start};
      const Tensor<1, 2> a = edge.start - edge.center,
                         b = edge.end - edge.center;
      const double sign    = edge.radius > 0. ? 1. : -1.;
      double sweep = std::atan2(sign * (a[0] * b[1] - a[1] * b[0]), a * b);
      if (sweep < 0.)
        sweep += 2. * dealii::numbers::PI;
      const double c = std::cos(sign * t * sweep),
                   s = std::sin(sign * t * sweep);
      const Point<2> spoke(c * a[0] - s * a[1], s * a[0] + c * a[1]);
      return {edge.center + spoke,
              sign * sweep * Point<2>(-spoke[1], spoke[0])};
    }


    /// Computes the interaction integrals of one tip.
    class InteractionIntegrals
    {
    public:
      InteractionIntegrals(const CoverSystem         &covers,
                           const ElasticityProblem   &problem,
                           const CrackTip            &tip,
                           const std::vector<double> &radii,
                           const ElementDisplacement &displacement,
                           const ElementGradient     &gradient,
                           const TipLoading          &loading,
                           DiskRules                 &rules)
        : covers(covers)
        , mesh(covers.manifold_mesh())
        , problem(problem)
        , tip(tip)
        , radii(radii)
        , smallest_radius(*std::min_element(radii.begin(), radii.end()))
        , largest_radius(*std::max_element(radii.begin(), radii.end()))
        , displacement(displacement)
        , gradient(gradient)
        , loading(loading)
        , region_to_material(problem.region_to_material(mesh.physical_mesh()))
        , material(problem.materials[region_to_material[tip.region]])
        , elasticity(material.plane_elasticity(problem.plane_state))
        , frame({{tip.direction[0], -tip.direction[1]},
                 {tip.direction[1], tip.direction[0]}})
        , initial_stress(dealii::symmetrize(
            in_frame(Tensor<2, 2>(material.initial_stress_at(tip.point)))))
        , fields{{{TipField::Kind::opening, elasticity},
                  {TipField::Kind::sliding, elasticity},
                  {TipField::Kind::point_force, elasticity}}}
        , force_at_tip(body_force(tip.point, material))
        , has_varying_force(problem.body_force || loading.acceleration ||
                            problem.has_forces_of_materials() ||
                            std::any_of(tip.regions.begin(),
                                        tip.regions.end(),
                                        [this](const unsigned int region) {
                                          return density(region) !=
                                                 material.density;
                                        }))
        // Whether the crack bends within the largest disk.
        , is_bent(tip.path.front().radius != 0. ||
                  tip.point.distance(tip.path.front().end) < largest_radius)
        , has_stress_jumps(std::any_of(tip.regions.begin(),
                                       tip.regions.end(),
                                       [this](const unsigned int region) {
                                         return extra_stress(region).norm() >
                                                0.;
                                       }))
        , has_varying_stress(problem.has_varying_initial_stress())
        , rules(rules)
        , gauss(rule_degree)
        , sums(n_fields * radii.size(), 0.)
        , contact_stress(radii.size(), 0.)
      {
        find_pressures();
      }


      std::vector<IntensityFactors>
      evaluate()
      {
        if (is_bent)
          find_displacement_of_tip();
        const bool has_faces = loading.face_traction || !pressures.empty() ||
                               is_bent || has_stress_jumps;
        const auto &cells        = mesh.mathematical_mesh();
        const auto [first, last] = covers.locally_owned_elements();
        for (unsigned int element = first; element < last; ++element)
        {
          const unsigned int cell = mesh.cell(element);
          if (std::find(tip.regions.begin(),
                        tip.regions.end(),
                        mesh.region(element)) == tip.regions.end() ||
              cells.reference_to_real(cell, {1. / 3., 1. / 3.})
                  .distance(tip.point) >
                largest_radius + cells.cell_diameter(cell))
            continue;
          add_area(element);
          if (has_faces)
            for (const ElementEdge &edge : mesh.edges(element))
              if (edge.curve_set != invalid_index)
                add_face(element, edge);
        }
        add_contact_forces();
        dealii::Utilities::MPI::sum(sums, covers.communicator(), sums);
        dealii::Utilities::MPI::sum(contact_stress,
                                    covers.communicator(),
                                    contact_stress);
        return factors();
      }

    private:
      /// The fields are those of opening, of sliding, and of the point force.
      static constexpr unsigned int n_fields = 3;

      const CoverSystem              &covers;
      const ManifoldMesh             &mesh;
      const ElasticityProblem        &problem;
      const CrackTip                 &tip;
      const std::vector<double>      &radii;
      const double                    smallest_radius, largest_radius;
      const ElementDisplacement      &displacement;
      const ElementGradient          &gradient;
      const TipLoading               &loading;
      const std::vector<unsigned int> region_to_material;
      const Material                 &material;
      const PlaneElasticity           elasticity;
      /// Matrix whose columns are the axes of the tip's frame.
      const Tensor<2, 2>                   frame;
      const SymmetricTensor<2, 2>          initial_stress;
      const std::array<TipField, n_fields> fields;
      /// Body force at the tip [N/m^3], in the tip's frame.
      const Tensor<1, 2> force_at_tip;
      /// Whether the force that acts on the solid differs from `force_at_tip` anywhere.
      const bool has_varying_force;
      const bool is_bent;
      /// Whether the initial stress of any region differs from `initial_stress`.
      const bool has_stress_jumps;
      /// Whether the initial stress of any region varies within it.
      const bool              has_varying_stress;
      DiskRules              &rules;
      const dealii::QGauss<1> gauss;
      Tensor<1, 2>            displacement_of_tip;
      /// Curves with a pressure on their faces, each with the boundary condition.
      std::vector<std::pair<unsigned int, const BoundaryCondition *>> pressures;
      /// Integral I of field f and disk d, at [n_fields * d + f].
      std::vector<double> sums;
      /// For each disk, the stress across the crack at its tip that contact transmits [Pa].
      std::vector<double> contact_stress;


      void
      find_pressures()
      {
        for (const BoundaryCondition &condition : problem.boundary_conditions)
          if (condition.is_pressure() && condition.value)
            for (const unsigned int curve :
                 condition.curves_in(mesh.physical_mesh()))
              if (mesh.physical_mesh().curves()[curve].role == CurveRole::joint)
                pressures.emplace_back(curve, &condition);
      }


      /// Traction on a face that lies on the curves @p on [Pa], in real coordinates.
      Tensor<1, 2>
      traction_at(const Point<2>                  &x,
                  const Tensor<1, 2>              &normal,
                  const std::vector<unsigned int> &on) const
      {
        Tensor<1, 2> traction;
        if (loading.face_traction)
          traction = loading.face_traction(x, normal);
        for (const auto &[curve, condition] : pressures)
          if (std::find(on.begin(), on.end(), curve) != on.end())
            traction -= condition->value->value(x) * normal;
        return traction;
      }


      double
      density(const unsigned int region) const
      {
        return problem.materials[region_to_material[region]].density;
      }


      /// Initial stress of a region at the tip without that of the tip's region [Pa].
      SymmetricTensor<2, 2>
      extra_stress(const unsigned int region) const
      {
        return problem.materials[region_to_material[region]].initial_stress_at(
                 tip.point) -
               material.initial_stress_at(tip.point);
      }


      /// Initial stress of a region at @p x without that at the tip [Pa], in the tip's frame.
      SymmetricTensor<2, 2>
      varying_stress(const unsigned int region, const Point<2> &x) const
      {
        const Material &here = problem.materials[region_to_material[region]];
        if (here.varying_initial_stress == nullptr)
          return {};
        return dealii::symmetrize(in_frame(Tensor<2, 2>(
          here.initial_stress_at(x) - here.initial_stress_at(tip.point))));
      }


      /// Body force with gravity [N/m^3] on a material, in the tip's frame.
      Tensor<1, 2>
      body_force(const Point<2> &x, const Material &material) const
      {
        Tensor<1, 2> force = material.weight_at(x, problem.gravity);
        if (problem.body_force)
          for (unsigned int c = 0; c < 2; ++c)
            force[c] += problem.body_force->value(x, c);
        return in_frame(force);
      }


      /// Transforms vectors and tensors to components in the tip's frame.
      Tensor<1, 2>
      in_frame(const Tensor<1, 2> &v) const
      {
        return dealii::transpose(frame) * v;
      }


      Tensor<2, 2>
      in_frame(const Tensor<2, 2> &t) const
      {
        return dealii::transpose(frame) * t * frame;
      }


      /// The fields at @p x. If @p x is on the crack, they are those of the face from which
      /// @p into_solid points into the solid.
      std::array<TipField::Values, n_fields>
      fields_at(const Point<2>     &x,
                const Tensor<1, 2> &into_solid = Tensor<1, 2>()) const
      {
        const double r     = x.distance(tip.point),
                     theta = tip.angle(x, into_solid);
        return {{fields[0].evaluate(r, theta),
                 fields[1].evaluate(r, theta),
                 fields[2].evaluate(r, theta)}};
      }


      void
      add_area(const unsigned int element)
      {
        const auto        &cells = mesh.mathematical_mesh();
        const unsigned int cell  = mesh.cell(element);
        // Near the tip q is constant, so that only a body force and an initial stress that vary
        // contribute.
        const bool is_on_plateau =
          std::all_of(cells.cell_vertices(cell).begin(),
                      cells.cell_vertices(cell).end(),
                      [&](const unsigned int v) {
                        return cells.vertices()[v].distance(tip.point) <
                               plateau * smallest_radius;
                      });
        if (is_on_plateau && !has_varying_force && !has_varying_stress)
          return;

        const double                 determinant = 2. * cells.cell_area(cell);
        const dealii::Quadrature<2> &rule        = rules.rule(mesh, element);
        for (unsigned int p = 0; p < rule.size(); ++p)
        {
          const Point<2> x = cells.reference_to_real(cell, rule.point(p));
          const double   r = x.distance(tip.point);
          if (!(r < largest_radius && r > 0.))
            continue;
          add_area_point(x,
                         in_frame(gradient(element, rule.point(p))),
                         varying_force(element, rule.point(p), x),
                         determinant * rule.weight(p));
          if (has_varying_stress)
            add_varying_stress(x,
                               varying_stress(mesh.region(element), x),
                               determinant * rule.weight(p));
        }
      }


      /// Body force without that at the tip, and with inertia [N/m^3], in the tip's frame.
      Tensor<1, 2>
      varying_force(const unsigned int element,
                    const Point<2>    &xi,
                    const Point<2>    &x) const
      {
        Tensor<1, 2> force;
        if (!has_varying_force)
          return force;
        const Material &here =
          problem.materials[region_to_material[mesh.region(element)]];
        force = body_force(x, here) - force_at_tip;
        if (loading.acceleration)
          force -= here.density * in_frame(loading.acceleration(element, xi));
        return force;
      }


      void
      add_area_point(const Point<2>     &x,
                     const Tensor<2, 2> &du,
                     const Tensor<1, 2> &varying_force,
                     const double        weight)
      {
        const Tensor<1, 2>          ray = in_frame(x - tip.point);
        const double                r   = ray.norm();
        const Tensor<1, 2>          du_1({du[0][0], du[1][0]});
        const SymmetricTensor<2, 2> stress =
          elasticity.stress(du) + initial_stress;
        const auto fields_here = fields_at(x);
        for (unsigned int f = 0; f < n_fields; ++f)
        {
          const TipField::Values &a = fields_here[f];
          const Tensor<1, 2>      a_1({a.gradient[0][0], a.gradient[1][0]});
          // This is -P_j without the term with delta_1j.
          const Tensor<1, 2> flux    = stress * a_1 + a.stress * du_1;
          const double       density = stress * dealii::symmetrize(a.gradient);
          const double       force_work = force_at_tip * a.displacement;
          for (unsigned int d = 0; d < radii.size(); ++d)
          {
            const auto [q, slope] = cut_off(r, radii[d]);
            sums[n_fields * d + f] +=
              weight *
              (slope / r * (flux * ray + ray[0] * (force_work - density)) -
               q * (varying_force * a_1));
          }
        }
      }


      /// Adds D : grad(q a_,1) for the part D of the initial stress that varies. The strain of a_,1
      /// follows from its stress.
      void
      add_varying_stress(const Point<2>              &x,
                         const SymmetricTensor<2, 2> &D,
                         const double                 weight)
      {
        const Tensor<1, 2> ray         = in_frame(x - tip.point);
        const double       r           = ray.norm();
        const auto         fields_here = fields_at(x);
        const double       lambda = elasticity.lambda, mu = elasticity.mu;
        for (unsigned int f = 0; f < n_fields; ++f)
        {
          const Tensor<2, 2>          &a = fields_here[f].gradient;
          const SymmetricTensor<2, 2> &s = fields_here[f].stress_derivatives[0];
          const double                 strain_work =
            (D * s - lambda / (2. * (lambda + mu)) * dealii::trace(s) *
                       dealii::trace(D)) /
            (2. * mu);
          const double work = ray * (D * Tensor<1, 2>({a[0][0], a[1][0]}));
          for (unsigned int d = 0; d < radii.size(); ++d)
          {
            const auto [q, slope] = cut_off(r, radii[d]);
            sums[n_fields * d + f] +=
              weight * (slope / r * work + q * strain_work);
          }
        }
      }


      /// Adds the integral over an edge along the crack. The points are those of a Gauss rule in
      /// the square root of the distance from the tip, in which the fields are smooth.
      void
      add_face(const unsigned int element, const ElementEdge &edge)
      {
        const double at_start = tip.point.distance(edge.start),
                     at_end   = tip.point.distance(edge.end);
        const double near     = std::min(at_start, at_end),
                     far      = std::max(at_start, at_end);
        if (near >= largest_radius)
          return;
        std::vector<unsigned int> curves;
        bool                      is_open = false;
        for (const unsigned int piece : mesh.curve_set(edge.curve_set))
        {
          curves.push_back(mesh.physical_mesh().piece_to_curve()[piece]);
          const Curve &curve = mesh.physical_mesh().curves()[curves.back()];
          is_open            = is_open || (curve.role == CurveRole::joint &&
                                curve.state == JointState::open);
        }
        // Curves that are tied run through the tip. Only the initial stress can differ there.
        if (!is_open && !has_stress_jumps)
          return;
        for (unsigned int p = 0; p < gauss.size(); ++p)
        {
          // Fraction of the way from the nearer to the farther end, and its derivative.
          double share = gauss.point(p)[0], rate = 1.;
          if (far > near)
          {
            const double root = std::sqrt(near), growth = std::sqrt(far) - root,
                         reached = root + share * growth;
            rate                 = 2. * reached * growth / (far - near);
            share = share * growth * (root + reached) / (far - near);
          }
          const EdgePoint at =
            point_on(edge, at_start < at_end ? share : 1. - share);
          const double r = at.x.distance(tip.point);
          // An edge that is shorter than coordinates can tell has no direction.
          if (r < largest_radius && r > 0. && at.velocity.norm() > 0.)
          {
            const double weight = gauss.weight(p) * rate * at.velocity.norm();
            if (is_open)
              add_face_point(element, at, curves, weight);
            if (has_stress_jumps)
              add_stress_jump(element, at, is_open, weight);
          }
        }
      }


      /// Adds the work of the traction -D n that the extra stress D of a region exerts on its edge
      /// in the elastic problem. On an interface, that of the other side is added with its element.
      void
      add_stress_jump(const unsigned int element,
                      const EdgePoint   &at,
                      const bool         is_open,
                      const double       weight)
      {
        const Tensor<1, 2> normal =
          Point<2>(at.velocity[1], -at.velocity[0]) / at.velocity.norm();
        const Tensor<1, 2> traction =
          in_frame(-1. * (extra_stress(mesh.region(element)) * normal));
        // The fields are continuous at an interface.
        const auto fields_here =
          fields_at(at.x, is_open ? -normal : Tensor<1, 2>());
        const double r = at.x.distance(tip.point);
        for (unsigned int f = 0; f < n_fields; ++f)
        {
          const Tensor<2, 2> &a = fields_here[f].gradient;
          const double work     = traction * Tensor<1, 2>({a[0][0], a[1][0]});
          for (unsigned int d = 0; d < radii.size(); ++d)
            sums[n_fields * d + f] -=
              weight * cut_off(r, radii[d]).first * work;
        }
      }


      void
      add_face_point(const unsigned int               element,
                     const EdgePoint                 &at,
                     const std::vector<unsigned int> &curves,
                     const double                     weight)
      {
        const Point<2>    &x        = at.x;
        const Tensor<1, 2> tangent  = at.velocity / at.velocity.norm();
        const Tensor<1, 2> normal   = Point<2>(tangent[1], -tangent[0]);
        const Tensor<1, 2> traction = in_frame(traction_at(x, normal, curves));
        const Tensor<1, 2> u =
          in_frame(displacement(element,
                                mesh.mathematical_mesh().real_to_reference(
                                  mesh.cell(element), x)) -
                   displacement_of_tip);
        const Tensor<1, 2> ray = in_frame(x - tip.point), s = in_frame(tangent),
                           n     = in_frame(normal);
        const double r           = ray.norm();
        const auto   fields_here = fields_at(x, -normal);
        for (unsigned int f = 0; f < n_fields; ++f)
        {
          const TipField::Values &a = fields_here[f];
          const double            load_work =
            traction * Tensor<1, 2>({a.gradient[0][0], a.gradient[1][0]}) +
            n[0] * (force_at_tip * a.displacement -
                    initial_stress * dealii::symmetrize(a.gradient));
          // The terms are s^a e_2 and its derivative along the face, times u.
          const SymmetricTensor<2, 2> stress_slope =
            s[0] * a.stress_derivatives[0] + s[1] * a.stress_derivatives[1];
          const double work = a.stress[0][1] * u[0] + a.stress[1][1] * u[1],
                       work_slope =
                         stress_slope[0][1] * u[0] + stress_slope[1][1] * u[1];
          for (unsigned int d = 0; d < radii.size(); ++d)
          {
            const auto [q, slope] = cut_off(r, radii[d]);
            double sum            = q * load_work;
            if (is_bent)
              sum += slope / r * (ray * s) * work + q * work_slope;
            sums[n_fields * d + f] -= weight * sum;
          }
        }
      }


      /// Adds the forces of contact between the faces. The header describes the treatment of those
      /// near the tip.
      void
      add_contact_forces()
      {
        if (loading.contact_forces.empty())
          return;
        const Tensor<1, 2> upwards =
          Point<2>(-tip.direction[1], tip.direction[0]);
        // The radius rho of each disk is at most the length of the straight piece of the crack
        // that ends at the tip.
        std::vector<double> rho;
        for (const double radius : radii)
          rho.push_back(std::min(near_tip * radius,
                                 tip.point.distance(tip.path.front().end)));
        // This is the force on the lower face, whose normal points upwards.
        std::vector<Tensor<1, 2>> near_force(radii.size());
        for (const ContactForce &contact : loading.contact_forces)
        {
          const double r = contact.x.distance(tip.point);
          if (r >= largest_radius || r == 0.)
            continue;
          const auto here  = fields_at(contact.x, -contact.normal),
                     other = fields_at(contact.x, contact.normal);
          for (unsigned int d = 0; d < radii.size(); ++d)
          {
            const double share = std::min(1., r * r / (rho[d] * rho[d]));
            const double near  = (1. - share) * (1. - share);
            near_force[d] += 7. * share * near *
                             (contact.normal * upwards > 0. ? 1. : -1.) *
                             contact.force;
            add_contact_force((1. - near) * contact.force, here, other, r, d);
          }
        }
        for (unsigned int d = 0; d < radii.size(); ++d)
        {
          const double                           r = 9. / 64. * rho[d];
          std::array<TipField::Values, n_fields> below, above;
          for (unsigned int f = 0; f < n_fields; ++f)
          {
            below[f] = fields[f].evaluate(r, -dealii::numbers::PI);
            above[f] = fields[f].evaluate(r, dealii::numbers::PI);
          }
          add_contact_force(near_force[d], below, above, r, d);
          contact_stress[d] += upwards * near_force[d] / (8. / 15. * rho[d]);
        }
      }


      /// Adds a contact force to the integrals over disk @p d. @p force acts on the face with the
      /// fields @p here, and the opposite force on the face with the fields @p other.
      void
      add_contact_force(const Tensor<1, 2>                           &force,
                        const std::array<TipField::Values, n_fields> &here,
                        const std::array<TipField::Values, n_fields> &other,
                        const double                                  r,
                        const unsigned int                            d)
      {
        const Tensor<1, 2> components = in_frame(force);
        const double       q          = cut_off(r, radii[d]).first;
        for (unsigned int f = 0; f < n_fields; ++f)
        {
          const Tensor<2, 2> jump = here[f].gradient - other[f].gradient;
          sums[n_fields * d + f] -=
            q * (components * Tensor<1, 2>({jump[0][0], jump[1][0]}));
        }
      }


      void
      find_displacement_of_tip()
      {
        // Each rank knows the displacement of its own elements only.
        const unsigned int element = mesh.find_element(tip.point);
        const auto [first, last]   = covers.locally_owned_elements();
        if (element >= first && element < last)
          displacement_of_tip =
            displacement(element,
                         mesh.mathematical_mesh().real_to_reference(
                           mesh.cell(element), tip.point));
        displacement_of_tip =
          dealii::Utilities::MPI::sum(displacement_of_tip,
                                      covers.communicator());
      }


      std::vector<IntensityFactors>
      factors() const
      {
        const double modulus     = plane_modulus(elasticity),
                     kappa       = kolosov_constant(elasticity),
                     nu          = (3. - kappa) / (1. + kappa);
        const Tensor<1, 2> below = -(frame * Point<2>(0., 1.));
        // The stress sigma_22 at the tip follows from the traction on the lower face.
        const double normal_stress =
          -in_frame(traction_at(tip.point, below, {tip.curve}))[1];
        std::vector<IntensityFactors> result(radii.size());
        for (unsigned int d = 0; d < radii.size(); ++d)
        {
          IntensityFactors &k = result[d];
          k.K_I               = 0.5 * modulus * sums[n_fields * d];
          k.K_II              = 0.5 * modulus * sums[n_fields * d + 1];
          k.T = modulus * sums[n_fields * d + 2] + normal_stress +
                contact_stress[d] + initial_stress[0][0] -
                nu * initial_stress[1][1];
          if (has_stress_jumps)
            k.T = std::numeric_limits<double>::quiet_NaN();
          k.energy_release_rate = (k.K_I * k.K_I + k.K_II * k.K_II) / modulus;
          k.radius              = radii[d];
        }
        return result;
      }
    };
  } // namespace


  bool
  has_intensity_factors(const CrackTip          &tip,
                        const PhysicalMesh      &physical_mesh,
                        const ElasticityProblem &problem)
  {
    const std::vector<unsigned int> region_to_material =
      problem.region_to_material(physical_mesh);
    const Material &first   = problem.materials[region_to_material[tip.region]];
    const PlaneElasticity e = first.plane_elasticity(problem.plane_state);
    return std::all_of(tip.regions.begin(),
                       tip.regions.end(),
                       [&](const unsigned int region) {
                         const Material &material =
                           problem.materials[region_to_material[region]];
                         const PlaneElasticity other =
                           material.plane_elasticity(problem.plane_state);
                         return other.lambda == e.lambda && other.mu == e.mu;
                       });
  }


  DiskRules::DiskRules()
    : whole_rule(make_triangle_rule(rule_degree))
    , builder(rule_degree)
  {
  }


  const dealii::Quadrature<2> &
  DiskRules::rule(const ManifoldMesh &mesh, const unsigned int element)
  {
    if (mesh.is_whole(element))
      return whole_rule;
    const auto [entry, is_new] = rules.try_emplace(element);
    if (is_new)
      entry->second =
        builder.build(mesh.edges(element), cell_frame(mesh, element));
    return entry->second;
  }


  std::vector<IntensityFactors>
  interaction_integrals(const CoverSystem         &covers,
                        const ElasticityProblem   &problem,
                        const CrackTip            &tip,
                        const std::vector<double> &radii,
                        const ElementDisplacement &displacement,
                        const ElementGradient     &gradient,
                        const TipLoading          &loading,
                        DiskRules                 *rules)
  {
    DiskRules own_rules;
    for (const double radius : radii)
      AssertThrow(radius > 0. && radius <= tip.free_radius,
                  InputError("The interaction integral has a radius of " +
                               std::to_string(radius) + " m",
                             "crack tip at " + to_string(tip.point),
                             "choose it positive and at most " +
                               std::to_string(tip.free_radius) +
                               " m, where something else than the crack "
                               "begins"));
    return InteractionIntegrals(covers,
                                problem,
                                tip,
                                radii,
                                displacement,
                                gradient,
                                loading,
                                rules != nullptr ? *rules : own_rules)
      .evaluate();
  }


  IntensityFactors
  compute_intensity_factors(const DisplacementField &field,
                            const ElasticityProblem &problem,
                            const CrackTip          &tip,
                            const double             largest_radius,
                            const TipLoading        &loading,
                            DiskRules               *rules)
  {
    const double largest =
      largest_radius > 0. ? largest_radius : 0.9 * tip.free_radius;
    std::vector<double> radii;
    for (const double share : {1., 0.9, 0.8, 0.7, 0.6})
      radii.push_back(share * largest);
    const std::vector<IntensityFactors> of_disks = interaction_integrals(
      field.cover_system(),
      problem,
      tip,
      radii,
      [&](const unsigned int element, const Point<2> &xi) {
        return field.displacement(element, xi);
      },
      [&](const unsigned int element, const Point<2> &xi) {
        return field.gradient(element, xi);
      },
      loading,
      rules);
    IntensityFactors result = of_disks.front();
    for (const IntensityFactors &other : of_disks)
      result.spread = std::max({result.spread,
                                std::abs(other.K_I - result.K_I),
                                std::abs(other.K_II - result.K_II)});
    return result;
  }
} // namespace NMM
