#include <nmm/base/exceptions.h>
#include <nmm/quadrature/element_quadrature.h>
#include <nmm/quadrature/element_rule_builder.h>

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/parallel.h>
#include <deal.II/base/quadrature_lib.h>

#include "element_triangles.h"
#include <algorithm>
#include <atomic>
#include <string>

namespace NMM
{
  dealii::Quadrature<2>
  make_triangle_rule(const unsigned int degree)
  {
    // Numbers of points of deal.II's rules with positive weights and points inside; the smallest
    // one is taken:
    // degree             1  2  3  4  5   6   7   8   9  10  11  12  13  14
    // QGaussSimplex      1     4     7      15
    // Witherden-Vincent  1  3  6  6  7  12  15  16  19  25  28  33  37  42
    AssertThrow(degree <= 14,
                InputError("Quadrature of degree " + std::to_string(degree) +
                             " on triangles",
                           "",
                           "deal.II has rules up to degree 14"));
    if (degree <= 1)
      return dealii::QGaussSimplex<2>(1);
    if (degree == 3)
      return dealii::QGaussSimplex<2>(2);
    return dealii::QWitherdenVincentSimplex<2>((degree + 1) / 2,
                                               degree % 2 == 1);
  }


  std::vector<dealii::Point<2>>
  ElementRule::get_points() const
  {
    std::vector<dealii::Point<2>> result(size());
    for (unsigned int q = 0; q < result.size(); ++q)
      result[q] = point(q);
    return result;
  }


  std::vector<double>
  ElementRule::get_weights() const
  {
    std::vector<double> result(size());
    for (unsigned int q = 0; q < result.size(); ++q)
      result[q] = weight(q);
    return result;
  }


  ElementRule::operator dealii::Quadrature<2>() const
  {
    return size() == 0 ? dealii::Quadrature<2>()
                       : dealii::Quadrature<2>(get_points(), get_weights());
  }


  namespace
  {
    /// Entries of element_to_rule from here on are a kind of division into triangles plus this.
    constexpr unsigned int divided = 1u << 31;

    /// Marks elements that need a rule of their own, while rules are made.
    constexpr unsigned int to_be_made = invalid_index - 1;


    /// Calls action(begin, end) for parts of the range [0, @p n), on the threads that deal.II may
    /// use.
    template <typename Action>
    void
    for_each_range(const unsigned int n, const Action &action)
    {
      constexpr unsigned int grain = 4096;
      if (dealii::MultithreadInfo::n_threads() == 1)
        action(0U, n);
      else
        dealii::parallel::apply_to_subranges(0U, n, action, grain);
    }
  } // namespace


  QuadratureCollection::QuadratureCollection(
    const ManifoldMesh                         &manifold_mesh,
    const unsigned int                          degree_whole,
    const unsigned int                          degree_cut,
    const std::pair<unsigned int, unsigned int> elements)
    : mesh(&manifold_mesh)
    , whole_rule(make_triangle_rule(degree_whole))
    , first_element(elements.first)
  {
    Assert(elements.first <= elements.second &&
             elements.second <= mesh->n_elements(),
           dealii::ExcMessage("No such range of elements."));
    constexpr unsigned int largest = 14;
    if (degree_cut <= largest)
      triangle_rule = make_triangle_rule(degree_cut);
    const unsigned int n = elements.second - elements.first;
    element_to_rule.assign(n, invalid_index);

    // Elements are independent of each other, so the result is the same on any number of threads.
    for_each_range(n, [&](const unsigned int begin, const unsigned int end) {
      divide(degree_cut, begin, end);
    });
    make_own_rules(degree_cut);
  }


  void
  QuadratureCollection::divide(const unsigned int degree,
                               const unsigned int begin,
                               const unsigned int end)
  {
    const unsigned int dimension = (degree + 1) * (degree + 2) / 2;
    const unsigned int max_triangles =
      triangle_rule.size() == 0 ? 0 : dimension / triangle_rule.size();
    for (unsigned int i = begin; i < end; ++i)
    {
      const unsigned int element = first_element + i;
      if (mesh->is_whole(element))
        continue;
      const internal::Triangles kind =
        internal::find_triangles(mesh->edges(element),
                                 cell_frame(*mesh, element),
                                 max_triangles);
      element_to_rule[i] = kind == internal::Triangles::none
                             ? to_be_made
                             : divided + static_cast<unsigned int>(kind);
    }
  }


  void
  QuadratureCollection::make_own_rules(const unsigned int degree)
  {
    std::vector<unsigned int> elements;
    for (unsigned int i = 0; i < element_to_rule.size(); ++i)
      if (element_to_rule[i] == to_be_made)
      {
        element_to_rule[i] = elements.size();
        elements.push_back(first_element + i);
      }
    std::vector<dealii::Quadrature<2>> rules(elements.size());
    std::atomic<unsigned int>          n_bad(0);
    for_each_range(elements.size(),
                   [&](const unsigned int begin, const unsigned int end) {
                     ElementRuleBuilder builder(degree);
                     for (unsigned int i = begin; i < end; ++i)
                     {
                       rules[i] = builder.build(mesh->edges(elements[i]),
                                                cell_frame(*mesh, elements[i]));
                       n_bad += builder.last_was_fallback();
                     }
                   });
    fallbacks = n_bad;

    first_point.reserve(rules.size() + 1);
    first_point.push_back(0);
    for (const dealii::Quadrature<2> &rule : rules)
      first_point.push_back(first_point.back() + rule.size());
    own_points.reserve(first_point.back());
    own_weights.reserve(first_point.back());
    for (const dealii::Quadrature<2> &rule : rules)
    {
      own_points.insert(own_points.end(),
                        rule.get_points().begin(),
                        rule.get_points().end());
      own_weights.insert(own_weights.end(),
                         rule.get_weights().begin(),
                         rule.get_weights().end());
    }
  }


  ElementRule
  QuadratureCollection::rule(const unsigned int element) const
  {
    AssertIndexRange(element - first_element, element_to_rule.size());
    const unsigned int index = element_to_rule[element - first_element];
    ElementRule        result;
    if (index < divided)
    {
      result.n_points = first_point[index + 1] - first_point[index];
      result.points   = own_points.data() + first_point[index];
      result.weights  = own_weights.data() + first_point[index];
      return result;
    }
    const dealii::Quadrature<2> &ordinary =
      index == invalid_index ? whole_rule : triangle_rule;
    result.n_points = ordinary.size();
    result.points   = ordinary.get_points().data();
    result.weights  = ordinary.get_weights().data();
    if (index != invalid_index)
      result.n_triangles =
        internal::set_triangles(static_cast<internal::Triangles>(index -
                                                                 divided),
                                mesh->edges(element),
                                cell_frame(*mesh, element),
                                result.triangles);
    return result;
  }


  double
  QuadratureCollection::area_fraction(const unsigned int element) const
  {
    AssertIndexRange(element - first_element, element_to_rule.size());
    if (element_to_rule[element - first_element] == invalid_index)
      return 1.;
    // The reference triangle has the area 1/2.
    const ElementRule element_rule = rule(element);
    double            area         = 0.;
    for (unsigned int q = 0; q < element_rule.size(); ++q)
      area += element_rule.weight(q);
    return std::min(2. * area, 1.);
  }


  unsigned int
  QuadratureCollection::n_fallbacks() const
  {
    return fallbacks;
  }
} // namespace NMM
