#include <nmm/base/exceptions.h>
#include <nmm/quadrature/element_quadrature.h>
#include <nmm/quadrature/element_rule_builder.h>

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/parallel.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <atomic>
#include <string>

namespace NMM
{
  dealii::Quadrature<2>
  make_triangle_rule(const unsigned int degree)
  {
    // Fewest points among deal.II's rules with positive weights inside:
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



  QuadratureCollection::QuadratureCollection(
    const ManifoldMesh                         &mesh,
    const unsigned int                          degree_whole,
    const unsigned int                          degree_cut,
    const std::pair<unsigned int, unsigned int> elements)
    : whole_rule(make_triangle_rule(degree_whole))
    , first_element(elements.first)
  {
    Assert(elements.first <= elements.second &&
             elements.second <= mesh.n_elements(),
           dealii::ExcMessage("No such range of elements."));
    const unsigned int n = elements.second - elements.first;
    element_to_rule.assign(n, invalid_index);
    area_fractions.assign(n, 1.);

    unsigned int n_cut = 0;
    for (unsigned int i = 0; i < n; ++i)
      if (!mesh.is_whole(elements.first + i))
        element_to_rule[i] = n_cut++;
    cut_rules.resize(n_cut);

    // each rule by itself, so that the same comes out on any number of threads
    std::atomic<unsigned int> n_bad(0);
    const auto                make_rules = [&](const unsigned int begin,
                                const unsigned int end) {
      n_bad += make_cut_rules(mesh, degree_cut, begin, end);
    };
    constexpr unsigned int grain = 4096;
    if (dealii::MultithreadInfo::n_threads() == 1)
      make_rules(0, n);
    else
      dealii::parallel::apply_to_subranges(0U, n, make_rules, grain);
    fallbacks = n_bad;
  }



  unsigned int
  QuadratureCollection::make_cut_rules(const ManifoldMesh &mesh,
                                       const unsigned int  degree,
                                       const unsigned int  begin,
                                       const unsigned int  end)
  {
    const MathematicalMesh &cells = mesh.mathematical_mesh();
    ElementRuleBuilder      builder(degree);
    unsigned int            n_bad = 0;
    for (unsigned int i = begin; i < end; ++i)
    {
      if (element_to_rule[i] == invalid_index)
        continue;
      const unsigned int     element = first_element + i;
      const unsigned int     cell    = mesh.cell(element);
      dealii::Quadrature<2> &rule    = cut_rules[element_to_rule[i]];
      rule                           = builder.build(mesh.edges(element),
                           {cells.vertices()[cells.cell_vertices(cell)[0]],
                                                      cells.jacobian(cell)});
      if (builder.last_was_fallback())
        ++n_bad;
      // the reference triangle has area 1/2
      double area = 0.;
      for (const double weight : rule.get_weights())
        area += weight;
      area_fractions[i] = std::min(2. * area, 1.);
    }
    return n_bad;
  }



  const dealii::Quadrature<2> &
  QuadratureCollection::rule(const unsigned int element) const
  {
    AssertIndexRange(element - first_element, element_to_rule.size());
    const unsigned int index = element_to_rule[element - first_element];
    return index == invalid_index ? whole_rule : cut_rules[index];
  }



  double
  QuadratureCollection::area_fraction(const unsigned int element) const
  {
    AssertIndexRange(element - first_element, area_fractions.size());
    return area_fractions[element - first_element];
  }



  unsigned int
  QuadratureCollection::n_fallbacks() const
  {
    return fallbacks;
  }
} // namespace NMM
