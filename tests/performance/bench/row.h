#ifndef nmm_tests_performance_bench_row_h
#define nmm_tests_performance_bench_row_h

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace NMM
{
  namespace Bench
  {
    /// What was not measured: an empty cell of the table.
    constexpr double none = std::numeric_limits<double>::quiet_NaN();


    /// One measured run. Times are wall times [s], of the slowest rank.
    struct Row
    {
      std::string name, method, kinematics, enforcement, stabilization, solver;
      double      degree = none, ranks = 1;

      /// @name Counts, the same on every machine
      /// @{
      double elements = none, cut_elements = none, unknowns = none,
             nonzeros = none, steps = none, iterations = none,
             factor_entries = none;
      /// @}

      /// @name Stages
      /// @{
      double geometry = none, mesh = none, cutting = none, covers = none,
             quadrature = none, sparsity = none, assembly = none,
             /// Ordering and symbolic factorization of a direct solver.
        analysis = none, factorization = none, solution = none, search = none,
             contact = none, output = none;
      /// From the curves to the answer; measuring the error does not count.
      double total = none;
      /// @}

      /// Relative to what error_kind says [-].
      double      error = none, second_error = none;
      std::string error_kind, second_error_kind;

      /// Largest resident size of the process, by how much this run raised it, and
      /// what is allocated in the end for what the case says, of all ranks [MB].
      double peak_memory = none, own_peak_memory = none, live_memory = none;
      /// For mesh, elements, covers, constraints and rules, the most of any rank [MB].
      double rank_memory = none;
      /// Numbers of the solution, in a fixed order, by which runs are compared.
      std::string probes;
      double      repetitions = 1;

      std::string size, date, cpu, versions;
    };


    /// Call action(column name, member) for each column, in the order of the table.
    template <typename R, typename Action>
    void
    for_each_column(R &row, const Action &action)
    {
      action("case", row.name);
      action("method", row.method);
      action("degree", row.degree);
      action("kinematics", row.kinematics);
      action("contact_enforcement", row.enforcement);
      action("stabilization", row.stabilization);
      action("solver", row.solver);
      action("ranks", row.ranks);
      action("elements", row.elements);
      action("cut_elements", row.cut_elements);
      action("unknowns", row.unknowns);
      action("nonzeros", row.nonzeros);
      action("steps", row.steps);
      action("iterations", row.iterations);
      action("factor_entries", row.factor_entries);
      action("geometry_s", row.geometry);
      action("mesh_s", row.mesh);
      action("cutting_s", row.cutting);
      action("covers_s", row.covers);
      action("quadrature_s", row.quadrature);
      action("sparsity_s", row.sparsity);
      action("assembly_s", row.assembly);
      action("analysis_s", row.analysis);
      action("factorization_s", row.factorization);
      action("solution_s", row.solution);
      action("contact_search_s", row.search);
      action("contact_terms_s", row.contact);
      action("output_s", row.output);
      action("total_s", row.total);
      action("error", row.error);
      action("error_kind", row.error_kind);
      action("second_error", row.second_error);
      action("second_error_kind", row.second_error_kind);
      action("peak_memory_MB", row.peak_memory);
      action("own_peak_memory_MB", row.own_peak_memory);
      action("live_memory_MB", row.live_memory);
      action("rank_memory_MB", row.rank_memory);
      action("probes", row.probes);
      action("repetitions", row.repetitions);
      action("size", row.size);
      action("date", row.date);
      action("cpu", row.cpu);
      action("versions", row.versions);
    }


    std::vector<std::string>
    column_names();

    void
    write_table(const std::string &file_name, const std::vector<Row> &rows);

    /// @throws InputError for a file that cannot be read, or other columns.
    std::vector<Row>
    read_table(const std::string &file_name);

    /// Columns date, cpu and versions.
    void
    describe_machine(Row &row);
  } // namespace Bench
} // namespace NMM

#endif
