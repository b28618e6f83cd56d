#ifndef nmm_covers_cover_functions_h
#define nmm_covers_cover_functions_h

#include <nmm/covers/cover_system.h>

#include <deal.II/base/function.h>

#include <map>
#include <memory>
#include <vector>

namespace NMM
{
  /**
   * Unknowns and basis functions of covers that have more than a constant. "Generally the local
   * function can be in any form" (the paper, section 2): with the weight function w_k of the
   * cover k and its functions phi_k0 = 1, phi_k1, phi_k2, ...
   * @f[ u_c(x) = \sum_k w_k(x) \sum_f \varphi_{kf}(x)\,a_{kfc} @f]
   * for each component c of the unknown field. A cover system, a number of components and the
   * further functions of some covers come in; basis functions and unknowns of each element go out,
   * for a program that assembles by itself (as step-nmm-0 does). The library's own assembly takes
   * covers of a constant; for functions of a crack tip it has DiskCover, which needs fewer unknowns
   * and keeps the order of accuracy.
   *
   * deal.II's FE_Enriched does the same for the cells of a DoFHandler; here functions belong to
   * physical covers, of which a cell may have several sets.
   *
   * Basis functions of an element are numbered by weight functions i, for each of them by
   * functions f. The unknowns of a cover follow one another, and covers are in the order of their
   * global numbers: component c of function f of the cover k is the unknown
   * @f[ n_c \Bigl(\sum_{l<k} n_l + f\Bigr) + c, @f]
   * where n_l is the number of functions of the cover l. Without further functions this is the
   * numbering of CoverSystem::get_dof_indices().
   *
   * Limits: products of weight functions and others are no polynomials in general, so that the rule
   * has to be chosen for them. Functions that are polynomials make the unknowns linearly dependent
   * if all covers have them. A function is evaluated at a place, without regard to the side of a
   * curve; but covers on both sides of one are different, and may have different functions.
   * Aggregation concerns constants only: give functions to covers that are not aggregated.
   *
   * Lifetime: the cover system must outlive this object.
   */
  class CoverFunctions
  {
  public:
    /// The further functions of covers, by global number: scalar functions of the place [m].
    using FurtherFunctions =
      std::map<unsigned int,
               std::vector<std::shared_ptr<const dealii::Function<2>>>>;

    /// Values and gradients of the basis functions of an element at a point.
    struct Basis
    {
      /// Values [-].
      std::vector<double> values;
      /// Gradients by the place x [1/m].
      std::vector<dealii::Tensor<1, 2>> gradients;
    };

    /// Number the unknowns of @p n_components components. @p further_functions must be the same on
    /// all ranks.
    /// @throws InputError if a cover does not exist.
    CoverFunctions(const CoverSystem &covers,
                   unsigned int       n_components,
                   FurtherFunctions   further_functions = {});

    /// Number of unknowns of all ranks.
    unsigned int
    n_unknowns() const;

    /// Get the global unknowns of an element: entry n_components * j + c belongs to its basis
    /// function j, component c.
    void
    get_dof_indices(
      unsigned int                                  element,
      std::vector<dealii::types::global_dof_index> &indices) const;

    /// Get the basis functions of an element at the reference coordinates @p xi of its cell.
    void
    evaluate(unsigned int            element,
             const dealii::Point<2> &xi,
             Basis                  &basis) const;

    /// Unknowns of the covers that this rank owns.
    dealii::IndexSet
    locally_owned_dofs() const;

    /// Unknowns of the covers whose values this rank needs.
    dealii::IndexSet
    locally_relevant_dofs() const;

  private:
    /// The first unknown of a cover (global number), which may be past the end.
    dealii::types::global_dof_index
    first_unknown(unsigned int cover) const;

    dealii::IndexSet
    unknowns_of(const dealii::IndexSet &covers) const;

    const CoverSystem *covers;
    unsigned int       n_components;
    FurtherFunctions   further_functions;
    /// For each cover with further functions, their number in this cover and those before it.
    std::map<unsigned int, unsigned int> n_further;
  };
} // namespace NMM

#endif
