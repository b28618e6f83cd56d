#ifndef nmm_source_scene_expression_h
#define nmm_source_scene_expression_h

#include <deal.II/base/function.h>

#include <memory>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * The @p expressions of @p variables ("x,y" or "t") as a function with a component for each of
     * them. @throws InputError naming @p parameter if an expression cannot be parsed.
     */
    template <int dim>
    std::shared_ptr<const dealii::Function<dim>>
    parse_expressions(const std::vector<std::string> &expressions,
                      const std::string              &variables,
                      const std::string              &parameter);
  } // namespace internal
} // namespace NMM

#endif
