#include <nmm/base/exceptions.h>
#include <nmm/mechanics/load_values.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/mpi.h>

#include <cmath>
#include <mechanics/curve_conditions.h>
#include <mechanics/trace_constant.h>
#include <sstream>

namespace NMM
{
  namespace
  {
    /// Message with the first component of @p function that is not finite at @p x; empty if all
    /// components are finite.
    std::string
    find_fault(const dealii::Function<2> &function,
               const dealii::Point<2>    &x,
               const std::string         &name)
    {
      for (unsigned int c = 0; c < function.n_components; ++c)
      {
        const double value = function.value(x, c);
        if (std::isfinite(value))
          continue;
        std::ostringstream text;
        text << name;
        const auto *parsed =
          dynamic_cast<const dealii::FunctionParser<2> *>(&function);
        if (parsed != nullptr)
          text << " '" << parsed->get_expressions()[c] << "'";
        text << " is " << value << " at " << to_string(x);
        return text.str();
      }
      return "";
    }


    /// Message with the first value that is not finite on the elements of this rank; empty if there
    /// is none.
    std::string
    find_local_fault(const CoverSystem          &covers,
                     const QuadratureCollection &quadrature,
                     const ElasticityProblem    &problem)
    {
      const ManifoldMesh     &mesh              = covers.manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const internal::CurveConditions conditions(mesh, problem);
      const bool varying_stress = problem.has_varying_initial_stress();
      const std::vector<unsigned int> region_to_material =
        problem.region_to_material(mesh.physical_mesh());
      std::string fault;
      const auto [first, last] = covers.locally_owned_elements();
      for (unsigned int e = first; e < last && fault.empty(); ++e)
      {
        const unsigned int           cell = mesh.cell(e);
        const dealii::Quadrature<2> &rule = quadrature.rule(e);
        if (varying_stress)
          if (const auto &stress =
                problem.materials[region_to_material[mesh.region(e)]]
                  .varying_initial_stress)
            for (unsigned int q = 0; q < rule.size() && fault.empty(); ++q)
              fault =
                find_fault(*stress,
                           mathematical_mesh.reference_to_real(cell,
                                                               rule.point(q)),
                           "the initial stress");
        if (problem.body_force != nullptr)
          for (unsigned int q = 0; q < rule.size() && fault.empty(); ++q)
            fault =
              find_fault(*problem.body_force,
                         mathematical_mesh.reference_to_real(cell,
                                                             rule.point(q)),
                         "the body force");
        for (const ElementEdge &edge : mesh.edges(e))
        {
          if (conditions.conditions(e, edge).empty())
            continue;
          const EdgeRule edge_rule =
            make_edge_rule(edge,
                           cell_frame(mesh, e),
                           2 * mathematical_mesh.degree());
          for (const unsigned int c : conditions.conditions(e, edge))
          {
            const BoundaryCondition &condition = problem.boundary_conditions[c];
            if (condition.value == nullptr)
              continue;
            for (const dealii::Point<2> &xi : edge_rule.points)
              if (fault.empty())
                fault =
                  find_fault(*condition.value,
                             mathematical_mesh.reference_to_real(cell, xi),
                             "the value of the boundary condition '" +
                               condition.name + "'");
          }
        }
      }
      return fault;
    }
  } // namespace


  void
  check_load_values(const CoverSystem          &covers,
                    const QuadratureCollection &quadrature,
                    const ElasticityProblem    &problem)
  {
    const auto faults = dealii::Utilities::MPI::all_gather(
      covers.communicator(), find_local_fault(covers, quadrature, problem));
    for (const std::string &fault : faults)
      AssertThrow(fault.empty(),
                  InputError(fault,
                             "",
                             "write it so that it has a value everywhere in "
                             "the solid, or on the boundary it is given for"));
  }
} // namespace NMM
