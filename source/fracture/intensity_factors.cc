#include <nmm/base/exceptions.h>
#include <nmm/fracture/intensity_factors.h>
#include <nmm/fracture/tip_field.h>
#include <nmm/quadrature/element_rule_builder.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace NMM
{
  namespace
  {
    using dealii::Point;
    using dealii::SymmetricTensor;
    using dealii::Tensor;

    constexpr unsigned int rule_degree = 10;

    /// The inner radius, where q begins to fall, over the outer one. Less leaves more room to
    /// fall, more keeps away from the tip, where the solution is least accurate.
    constexpr double plateau = 0.2;



    /// q(r) and its derivative.
    std::pair<double, double>
    cut_off(const double r, const double outer)
    {
      const double width = (1. - plateau) * outer;
      const double t     = std::min(1., std::max(0., (outer - r) / width));
      return {t * t * t * t * (35. + t * (-84. + t * (70. - 20. * t))),
              -140. * std::pow(t * (1. - t), 3) / width};
    }


    template <std::size_t n>
    void
    sum_over_ranks(std::array<double, n> &values, const MPI_Comm communicator)
    {
      dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(values.data(),
                                                                  n),
                                  communicator,
                                  dealii::ArrayView<double>(values.data(), n));
    }


    /// A point of an element's edge, x(t) with t in [0, 1] from its start.
    struct EdgePoint
    {
      Point<2> x;
      /// dx/dt [m]
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
  } // namespace



  class InteractionIntegrals::Builder
  {
  public:
    Builder(InteractionIntegrals    &integrals,
            const ElasticityProblem &problem,
            const FaceTraction      &face_traction)
      : integrals(integrals)
      , tip(integrals.tip)
      , radius(integrals.radius)
      , mesh(integrals.covers->manifold_mesh())
      , problem(problem)
      , material(problem.materials[problem.region_to_material(
          mesh.physical_mesh())[tip.region]])
      , elasticity(material.plane_elasticity(problem.plane_state))
      , face_traction(face_traction)
      , e_1(tip.direction)
      , e_2(Point<2>(-e_1[1], e_1[0]))
      , fields{{{TipField::Kind::opening, elasticity},
                {TipField::Kind::sliding, elasticity},
                {TipField::Kind::point_force, elasticity}}}
      , force_at_tip(body_force(tip.point))
      , rules(rule_degree)
      , gauss(rule_degree)
    {
      for (unsigned int i = 0; i < 2; ++i)
      {
        frame[i][0] = e_1[i];
        frame[i][1] = e_2[i];
      }
    }


    void
    build()
    {
      set_constants();
      const bool  has_faces    = face_traction || is_bent();
      const auto &cells        = mesh.mathematical_mesh();
      const auto [first, last] = integrals.covers->locally_owned_elements();
      for (unsigned int element = first; element < last; ++element)
      {
        const unsigned int cell = mesh.cell(element);
        if (mesh.region(element) != tip.region ||
            cells.reference_to_real(cell, {1. / 3., 1. / 3.})
                .distance(tip.point) > radius + cells.cell_diameter(cell))
          continue;
        add_area(element);
        if (has_faces)
          for (const ElementEdge &edge : mesh.edges(element))
            if (edge.curve_set != invalid_index)
              add_face(element, edge);
      }
    }

  private:
    InteractionIntegrals    &integrals;
    const CrackTip          &tip;
    const double             radius;
    const ManifoldMesh      &mesh;
    const ElasticityProblem &problem;
    const Material          &material;
    const PlaneElasticity    elasticity;
    const FaceTraction      &face_traction;
    /// Of the tip's frame; its axes are the columns of `frame`.
    const Tensor<1, 2>                   e_1, e_2;
    Tensor<2, 2>                         frame;
    const std::array<TipField, n_fields> fields;
    const Tensor<1, 2>                   force_at_tip;
    ElementRuleBuilder                   rules;
    const dealii::QGauss<1>              gauss;


    Tensor<1, 2>
    body_force(const Point<2> &x) const
    {
      Tensor<1, 2> force = material.density * problem.gravity;
      if (problem.body_force)
        for (unsigned int c = 0; c < 2; ++c)
          force[c] += problem.body_force->value(x, c);
      return force;
    }


    /// Does the crack bend within the disk?
    bool
    is_bent() const
    {
      return tip.path.front().radius != 0. ||
             tip.point.distance(tip.path.front().end) < radius;
    }


    void
    set_constants()
    {
      const double kappa        = kolosov_constant(elasticity);
      const double nu           = (3. - kappa) / (1. + kappa);
      integrals.modulus         = plane_modulus(elasticity);
      const auto &initial       = material.initial_stress;
      double      normal_stress = 0.;
      if (face_traction)
        normal_stress = -(face_traction(tip.point, -e_2) * e_2);
      integrals.normal_part =
        normal_stress + e_1 * (initial * e_1) - nu * (e_2 * (initial * e_2));
    }


    /// The field @p f at @p x on the side of the crack into which @p into_solid points, in
    /// components of the mesh.
    TipField::Values
    field(const unsigned int  f,
          const Point<2>     &x,
          const Tensor<1, 2> &into_solid = Tensor<1, 2>()) const
    {
      TipField::Values values =
        fields[f].evaluate(x.distance(tip.point), tip.angle(x, into_solid));
      const auto turn = [this](const SymmetricTensor<2, 2> &t) {
        return dealii::symmetrize(frame * Tensor<2, 2>(t) *
                                  dealii::transpose(frame));
      };
      values.displacement = frame * values.displacement;
      values.gradient     = frame * values.gradient * dealii::transpose(frame);
      values.stress       = turn(values.stress);
      for (auto &derivative : values.stress_derivatives)
        derivative = turn(derivative);
      return values;
    }


    dealii::Quadrature<2>
    rule(const unsigned int element)
    {
      if (mesh.is_whole(element))
        return make_triangle_rule(rule_degree);
      const auto        &cells = mesh.mathematical_mesh();
      const unsigned int cell  = mesh.cell(element);
      return rules.build(mesh.edges(element),
                         {cells.vertices()[cells.cell_vertices(cell)[0]],
                          cells.jacobian(cell)});
    }


    void
    add_area(const unsigned int element)
    {
      const auto        &cells = mesh.mathematical_mesh();
      const unsigned int cell  = mesh.cell(element);
      // Near the tip q is constant: nothing to integrate without a body force that varies.
      const bool is_on_plateau =
        std::all_of(cells.cell_vertices(cell).begin(),
                    cells.cell_vertices(cell).end(),
                    [&](const unsigned int v) {
                      return cells.vertices()[v].distance(tip.point) <
                             plateau * radius;
                    });
      if (is_on_plateau && !problem.body_force)
        return;

      const double                determinant = 2. * cells.cell_area(cell);
      const dealii::Quadrature<2> points      = rule(element);
      for (unsigned int p = 0; p < points.size(); ++p)
      {
        const Point<2> x = cells.reference_to_real(cell, points.point(p));
        const double   r = x.distance(tip.point);
        if (r >= radius || r == 0.)
          continue;
        const double weight   = determinant * points.weight(p);
        const auto [q, slope] = cut_off(r, radius);
        const Tensor<1, 2> dq = slope / r * (x - tip.point);

        GradientPoint point;
        point.element = element;
        point.xi      = points.point(p);
        for (unsigned int f = 0; f < n_fields; ++f)
        {
          const TipField::Values a = field(f, x);
          // -P_j q_j = sigma : m + (s^a dq) . u_,1
          const SymmetricTensor<2, 2> m =
            dealii::symmetrize(dealii::outer_product(a.gradient * e_1, dq)) -
            (e_1 * dq) * dealii::symmetrize(a.gradient);
          point.kernels[f] =
            weight * (Tensor<2, 2>(elasticity.stress(Tensor<2, 2>(m))) +
                      dealii::outer_product(a.stress * dq, e_1));
          integrals.constants[f] +=
            weight * (material.initial_stress * m +
                      (e_1 * dq) * (force_at_tip * a.displacement));
          if (problem.body_force)
            integrals.constants[f] -=
              weight * q *
              ((body_force(x) - force_at_tip) * (a.gradient * e_1));
        }
        if (slope != 0.)
          integrals.gradient_points.push_back(point);
      }
    }


    /// An edge along the crack. Its points are those of a Gauss rule in the root of the
    /// distance from the tip, which makes the fields smooth.
    void
    add_face(const unsigned int element, const ElementEdge &edge)
    {
      const auto        &cells    = mesh.mathematical_mesh();
      const unsigned int cell     = mesh.cell(element);
      const double       at_start = tip.point.distance(edge.start),
                   at_end         = tip.point.distance(edge.end);
      const bool   starts_nearer  = at_start < at_end;
      const double near           = std::min(at_start, at_end),
                   far            = std::max(at_start, at_end);
      if (near >= radius)
        return;
      for (unsigned int p = 0; p < gauss.size(); ++p)
      {
        // share of the way from the nearer to the farther end
        double share = gauss.point(p)[0], rate = 1.;
        if (far > near)
        {
          const double root = std::sqrt(near), growth = std::sqrt(far) - root,
                       reached = root + share * growth;
          rate                 = 2. * reached * growth / (far - near);
          share = share * growth * (root + reached) / (far - near);
        }
        const EdgePoint at = point_on(edge, starts_nearer ? share : 1. - share);
        const double    r  = at.x.distance(tip.point);
        if (r >= radius || r == 0.)
          continue;
        const double       speed   = at.velocity.norm();
        const Tensor<1, 2> tangent = at.velocity / speed;
        const Tensor<1, 2> normal  = Point<2>(tangent[1], -tangent[0]);
        const double       weight  = gauss.weight(p) * rate * speed;
        add_face_point(element,
                       cells.real_to_reference(cell, at.x),
                       at.x,
                       tangent,
                       normal,
                       weight);
      }
    }


    void
    add_face_point(const unsigned int  element,
                   const Point<2>     &xi,
                   const Point<2>     &x,
                   const Tensor<1, 2> &tangent,
                   const Tensor<1, 2> &normal,
                   const double        weight)
    {
      const double r        = x.distance(tip.point);
      const auto [q, slope] = cut_off(r, radius);
      const Tensor<1, 2> dq = slope / r * (x - tip.point);
      Tensor<1, 2>       traction;
      if (face_traction)
        traction = face_traction(x, normal);

      FacePoint point;
      point.element = element;
      point.xi      = xi;
      for (unsigned int f = 0; f < n_fields; ++f)
      {
        const TipField::Values a = field(f, x, -normal);
        // along the face, in the directions of the tip's frame
        const SymmetricTensor<2, 2> stress_slope =
          (tangent * e_1) * a.stress_derivatives[0] +
          (tangent * e_2) * a.stress_derivatives[1];
        point.kernels[f] = -weight * ((dq * tangent) * (a.stress * e_2) +
                                      q * (stress_slope * e_2));
        if (is_bent())
          integrals.face_resultants[f] += point.kernels[f];
        integrals.constants[f] -=
          weight * q *
          (traction * (a.gradient * e_1) +
           (normal * e_1) *
             (force_at_tip * a.displacement -
              material.initial_stress * dealii::symmetrize(a.gradient)));
      }
      if (is_bent())
        integrals.face_points.push_back(point);
    }
  };



  InteractionIntegrals::InteractionIntegrals(const CoverSystem       &covers,
                                             const ElasticityProblem &problem,
                                             const CrackTip          &tip,
                                             const double        outer_radius,
                                             const FaceTraction &face_traction)
    : covers(&covers)
    , tip(tip)
    , radius(outer_radius)
  {
    AssertThrow(outer_radius > 0. && outer_radius <= tip.free_radius,
                InputError("The interaction integral has a radius of " +
                             std::to_string(outer_radius) + " m",
                           "crack tip at " + to_string(tip.point),
                           "choose it positive and at most " +
                             std::to_string(tip.free_radius) +
                             " m, where something else than the crack begins"));
    Builder(*this, problem, face_traction).build();

    namespace MPI = dealii::Utilities::MPI;
    sum_over_ranks(constants, covers.communicator());
    for (auto &resultant : face_resultants)
      resultant = MPI::sum(resultant, covers.communicator());
  }



  IntensityFactors
  InteractionIntegrals::evaluate(const Displacement &displacement,
                                 const Gradient     &gradient) const
  {
    std::array<double, n_fields> sums{};
    for (const GradientPoint &point : gradient_points)
    {
      const Tensor<2, 2> du = gradient(point.element, point.xi);
      for (unsigned int f = 0; f < n_fields; ++f)
        sums[f] += dealii::scalar_product(point.kernels[f], du);
    }
    for (const FacePoint &point : face_points)
    {
      const Tensor<1, 2> u = displacement(point.element, point.xi);
      for (unsigned int f = 0; f < n_fields; ++f)
        sums[f] += point.kernels[f] * u;
    }
    const ManifoldMesh &mesh    = covers->manifold_mesh();
    const unsigned int  element = mesh.find_owned_element(tip.point);
    unsigned int        n_found = element != invalid_index;
    Tensor<1, 2>        at_tip;
    if (element != invalid_index)
      at_tip = displacement(element,
                            mesh.mathematical_mesh().real_to_reference(
                              mesh.cell(element), tip.point));

    namespace MPI               = dealii::Utilities::MPI;
    const MPI_Comm communicator = covers->communicator();
    sum_over_ranks(sums, communicator);
    n_found = MPI::sum(n_found, communicator);
    at_tip  = MPI::sum(at_tip, communicator) / n_found;
    for (unsigned int f = 0; f < n_fields; ++f)
      sums[f] += constants[f] - face_resultants[f] * at_tip;

    IntensityFactors result;
    result.K_I    = 0.5 * modulus * sums[0];
    result.K_II   = 0.5 * modulus * sums[1];
    result.T      = modulus * sums[2] + normal_part;
    result.radius = radius;
    result.energy_release_rate =
      (result.K_I * result.K_I + result.K_II * result.K_II) / modulus;
    return result;
  }



  IntensityFactors
  InteractionIntegrals::evaluate(const DisplacementField &field) const
  {
    return evaluate(
      [&](const unsigned int element, const Point<2> &xi) {
        return field.displacement(element, xi);
      },
      [&](const unsigned int element, const Point<2> &xi) {
        return field.gradient(element, xi);
      });
  }



  std::size_t
  InteractionIntegrals::n_points() const
  {
    return gradient_points.size();
  }



  IntensityFactors
  compute_intensity_factors(const DisplacementField &field,
                            const ElasticityProblem &problem,
                            const CrackTip          &tip,
                            const double             largest_radius,
                            const FaceTraction      &face_traction)
  {
    const double largest =
      largest_radius > 0. ? largest_radius : 0.9 * tip.free_radius;
    IntensityFactors result;
    for (const double share : {1., 0.9, 0.8, 0.7, 0.6})
    {
      const IntensityFactors other = InteractionIntegrals(field.cover_system(),
                                                          problem,
                                                          tip,
                                                          share * largest,
                                                          face_traction)
                                       .evaluate(field);
      if (share == 1.)
        result = other;
      result.spread = std::max({result.spread,
                                std::abs(other.K_I - result.K_I),
                                std::abs(other.K_II - result.K_II)});
    }
    return result;
  }
} // namespace NMM
