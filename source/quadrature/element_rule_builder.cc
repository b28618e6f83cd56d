#include <nmm/base/exceptions.h>
#include <nmm/quadrature/element_rule_builder.h>

#include "element_frame.h"
#include "element_triangles.h"
#include "moments.h"
#include "rule_reduction.h"
#include "slab_candidates.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace NMM
{
  namespace
  {
    constexpr unsigned int n_levels = 4;
    constexpr double       epsilon  = std::numeric_limits<double>::epsilon();
  } // namespace


  struct ElementRuleBuilder::Data
  {
    explicit Data(const unsigned int degree)
      : basis(degree)
    {
      constexpr unsigned int largest = 14;
      if (degree <= largest)
        triangle_rule = make_triangle_rule(degree);
    }

    internal::ElementFrame   frame;
    internal::GaussTable     gauss;
    internal::LegendreBasis  basis;
    internal::SlabCandidates candidates;
    internal::RuleReduction  reduction;

    std::vector<double>           moments, values, weights;
    std::vector<double>           best_weights;
    std::vector<dealii::Point<2>> best_points;
    double                        best_error = 0.;

    bool         fallback   = false;
    unsigned int n_attempts = 0;

    /// Rule on the reference triangle; empty if deal.II has none of this degree.
    dealii::Quadrature<2> triangle_rule;

    /// Sets the rule of a well-shaped triangle or convex quadrilateral; returns false if the
    /// element has another shape.
    bool
    divide(const dealii::ArrayView<const ElementEdge> &edges,
           const CellFrame                            &cell);

    void
    keep_if_best(double error);

    dealii::Quadrature<2>
    result() const;
  };


  ElementRuleBuilder::ElementRuleBuilder(const unsigned int degree)
    : data(std::make_unique<Data>(degree))
  {
    AssertThrow(degree <= max_degree,
                InputError("Quadrature of degree " + std::to_string(degree),
                           "",
                           "ask for at most " + std::to_string(max_degree)));
  }


  ElementRuleBuilder::~ElementRuleBuilder() = default;

  ElementRuleBuilder::ElementRuleBuilder(ElementRuleBuilder &&) noexcept =
    default;


  bool
  ElementRuleBuilder::last_was_fallback() const
  {
    return data->fallback;
  }


  unsigned int
  ElementRuleBuilder::n_attempts() const
  {
    return data->n_attempts;
  }


  bool
  ElementRuleBuilder::Data::divide(
    const dealii::ArrayView<const ElementEdge> &edges,
    const CellFrame                            &cell)
  {
    const unsigned int n_points = triangle_rule.size();
    const std::size_t  dimension =
      (basis.degree() + 1) * (basis.degree() + 2) / 2;
    if (n_points == 0)
      return false;
    ElementRule::Triangle triangles[2];
    const unsigned int    n_triangles = internal::set_triangles(
      internal::find_triangles(edges, cell, dimension / n_points),
      edges,
      cell,
      triangles);
    for (unsigned int i = 0; i < n_triangles; ++i)
      for (unsigned int q = 0; q < n_points; ++q)
      {
        const dealii::Point<2> &xi = triangle_rule.point(q);
        best_points.push_back(triangles[i].origin +
                              xi[0] * triangles[i].sides[0] +
                              xi[1] * triangles[i].sides[1]);
        best_weights.push_back(triangles[i].twice_the_area *
                               triangle_rule.weight(q));
      }
    return n_triangles > 0;
  }


  void
  ElementRuleBuilder::Data::keep_if_best(const double error)
  {
    if (!best_points.empty() && error >= best_error)
      return;
    best_error = error;
    best_points.clear();
    best_weights.clear();
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (weights[k] > 0.)
      {
        best_points.push_back(candidates.reference[k]);
        best_weights.push_back(weights[k] / frame.reference_to_scaled_area());
      }
  }


  dealii::Quadrature<2>
  ElementRuleBuilder::Data::result() const
  {
    return best_points.empty()
             ? dealii::Quadrature<2>()
             : dealii::Quadrature<2>(best_points, best_weights);
  }


  dealii::Quadrature<2>
  ElementRuleBuilder::build(const dealii::ArrayView<const ElementEdge> &edges,
                            const CellFrame                            &cell)
  {
    Data &d      = *data;
    d.fallback   = false;
    d.n_attempts = 0;
    d.best_points.clear();
    d.best_weights.clear();
    if (edges.size() == 0)
      return d.result();
    for (const ElementEdge &edge : edges)
      AssertThrow(std::isfinite(edge.start.norm_square() +
                                edge.end.norm_square() +
                                edge.center.norm_square()),
                  NumericalFailure("The boundary of an element is not finite",
                                   to_string(edge.start),
                                   "check the coordinates of the curves "
                                   "there"));
    if (d.divide(edges, cell))
    {
      d.n_attempts = 1;
      return d.result();
    }
    if (!d.frame.reinit(edges, cell))
      return d.result();

    const double scale = d.basis.moments(d.frame.edges(), d.gauss, d.moments);
    if (d.moments[0] <=
        std::max(d.frame.area_resolution(), 16. * epsilon * scale))
      return d.result();

    // An error of a moment is tolerable up to 1e-13 of the integral of the |monomial| over the
    // box of the element. The box has an area of at least 2 in scaled coordinates, and the mean
    // of |s_1^i s_2^j| over it is 1 / (i + 1) / (j + 1).
    const double mean       = std::pow(0.5 * d.basis.degree() + 1., -2.);
    const double tolerable  = 1e-13 * 2. * mean;
    const double goal       = 2. * epsilon * std::max(scale, 1.);
    const double acceptable = std::max(tolerable / 8., goal);
    for (unsigned int level = 0; level < n_levels; ++level)
    {
      d.candidates.reinit(d.frame, d.basis.degree(), level, d.gauss);
      ++d.n_attempts;
      if (d.candidates.weights.empty())
        continue;
      d.basis.evaluate(d.candidates.s1, d.candidates.s2, d.values);
      d.weights = d.candidates.weights;
      if (!d.reduction.reduce(
            d.values, d.moments, 4. * epsilon * scale, true, d.weights))
      {
        // This happens on thin bent strips, where some polynomials nearly vanish, so that their
        // moments are round-off. The moments of the candidates themselves may still be good
        // enough.
        d.weights = d.candidates.weights;
        d.reduction.reduce(d.values, d.moments, 0., false, d.weights);
      }
      const double error =
        d.reduction.polish(d.values, d.moments, goal, d.weights);
      d.keep_if_best(error);
      if (error <= acceptable)
        return d.result();
    }

    d.fallback = d.best_points.empty() || d.best_error > tolerable;
    return d.result();
  }


  dealii::Quadrature<2>
  make_element_rule(const dealii::ArrayView<const ElementEdge> edges,
                    const CellFrame                           &frame,
                    const unsigned int                         degree)
  {
    // Tables and scratch memory are kept for later calls.
    thread_local std::map<unsigned int, ElementRuleBuilder> builders;
    auto it = builders.find(degree);
    if (it == builders.end())
      it = builders.emplace(degree, ElementRuleBuilder(degree)).first;
    return it->second.build(edges, frame);
  }
} // namespace NMM
