#include <nmm/base/exceptions.h>
#include <nmm/covers/cover_functions.h>
#include <nmm/covers/weight_functions.h>

#include <iterator>
#include <string>
#include <utility>

namespace NMM
{
  CoverFunctions::CoverFunctions(const CoverSystem &covers,
                                 const unsigned int n_components,
                                 FurtherFunctions   further_functions)
    : covers(&covers)
    , n_components(n_components)
    , further_functions(std::move(further_functions))
  {
    unsigned int n = 0;
    for (const auto &[cover, functions] : this->further_functions)
    {
      AssertThrow(cover < covers.n_global_covers(),
                  InputError("functions are given for cover " +
                               std::to_string(cover) + " of " +
                               std::to_string(covers.n_global_covers()),
                             "CoverFunctions",
                             "give the global number of a cover"));
      n += functions.size();
      n_further[cover] = n;
    }
  }


  dealii::types::global_dof_index
  CoverFunctions::first_unknown(const unsigned int cover) const
  {
    const auto next = n_further.lower_bound(cover);
    return n_components *
           (cover + (next == n_further.begin() ? 0 : std::prev(next)->second));
  }


  unsigned int
  CoverFunctions::n_unknowns() const
  {
    return first_unknown(covers->n_global_covers());
  }


  void
  CoverFunctions::get_dof_indices(
    const unsigned int                            element,
    std::vector<dealii::types::global_dof_index> &indices) const
  {
    indices.clear();
    for (const unsigned int k : covers->covers(element))
    {
      const unsigned int cover = covers->global_cover(k);
      for (auto i = first_unknown(cover); i < first_unknown(cover + 1); ++i)
        indices.push_back(i);
    }
  }


  void
  CoverFunctions::evaluate(const unsigned int      element,
                           const dealii::Point<2> &xi,
                           Basis                  &basis) const
  {
    const ManifoldMesh        &mesh  = covers->manifold_mesh();
    const MathematicalMesh    &cells = mesh.mathematical_mesh();
    const unsigned int         cell  = mesh.cell(element);
    const dealii::Point<2>     x     = cells.reference_to_real(cell, xi);
    const dealii::Tensor<2, 2> to_real =
      transpose(invert(cells.jacobian(cell)));
    double w[WeightFunctions::max_per_cell],
      reference_gradients[WeightFunctions::max_per_cell][2];
    WeightFunctions::values(cells.degree(), xi, w);
    WeightFunctions::gradients(cells.degree(), xi, reference_gradients);

    basis.values.clear();
    basis.gradients.clear();
    unsigned int i = 0;
    for (const unsigned int k : covers->covers(element))
    {
      const dealii::Tensor<1, 2> gradient =
        to_real * dealii::Tensor<1, 2>(
                    {reference_gradients[i][0], reference_gradients[i][1]});
      basis.values.push_back(w[i]);
      basis.gradients.push_back(gradient);
      const auto further = further_functions.find(covers->global_cover(k));
      if (further != further_functions.end())
        for (const auto &function : further->second)
        {
          const double value = function->value(x);
          basis.values.push_back(w[i] * value);
          basis.gradients.push_back(value * gradient +
                                    w[i] * function->gradient(x));
        }
      ++i;
    }
  }


  dealii::IndexSet
  CoverFunctions::unknowns_of(const dealii::IndexSet &of_covers) const
  {
    dealii::IndexSet result(n_unknowns());
    for (const auto cover : of_covers)
      result.add_range(first_unknown(cover), first_unknown(cover + 1));
    result.compress();
    return result;
  }


  dealii::IndexSet
  CoverFunctions::locally_owned_dofs() const
  {
    return unknowns_of(covers->locally_owned_covers());
  }


  dealii::IndexSet
  CoverFunctions::locally_relevant_dofs() const
  {
    return unknowns_of(covers->locally_relevant_covers());
  }
} // namespace NMM
