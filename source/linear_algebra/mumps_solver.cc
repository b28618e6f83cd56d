#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>
#include <array>
#include <dmumps_c.h>
#include <linear_algebra/body_lu.h>
#include <linear_algebra/klu_solver.h>
#include <linear_algebra/mumps_solver.h>
#include <numeric>
#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      void
      check(const std::array<int, 2> &info, const std::string &stage)
      {
        AssertThrow(info[0] >= 0,
                    NumericalFailure(
                      "MUMPS' " + stage + " failed with the error code " +
                        std::to_string(info[0]) + ", " +
                        std::to_string(info[1]),
                      "",
                      info[0] == -10 || info[0] == -6
                        ? "the system is singular: check that every block is "
                          "held and has an area above rounding"
                        : "the system may be too large for this machine's "
                          "memory: choose the iterative solver or a coarser "
                          "mesh"));
      }
    } // namespace


    /// One MUMPS instance; control parameters by their number in the manual.
    class Mumps
    {
    public:
      Mumps(const MPI_Comm communicator, const bool is_symmetric)
        : data()
      {
        data.comm_fortran = MPI_Comm_c2f(communicator);
        data.par          = 1; // the host computes too
        // Symmetric, not "positive definite": a matrix that is indefinite by
        // rounding is then reported by its residual instead of an error.
        data.sym = is_symmetric ? 2 : 0;
        check(run(-1), "initialization");
        for (int i = 1; i <= 4; ++i)
          control(i) = i < 4 ? -1 : 0; // no output
      }

      ~Mumps()
      {
        data.job = -2;
        dmumps_c(&data);
      }

      Mumps(const Mumps &) = delete;
      Mumps &
      operator=(const Mumps &) = delete;

      MUMPS_INT &
      control(const int i)
      {
        return data.icntl[i - 1];
      }

      /// Error code and what it is about.
      std::array<int, 2>
      run(const int job)
      {
        data.job = job;
        dmumps_c(&data);
        return {{data.infog[0], data.infog[1]}};
      }

      DMUMPS_STRUC_C data;
    };


    /// Coordinates from 1 and values; of a symmetric matrix the upper
    /// triangle.
    struct Triplets
    {
      std::vector<MUMPS_INT> rows, columns;
      std::vector<double>    values;

      /// Call action(row, column, value) for each entry that is kept.
      template <typename Action>
      static void
      for_each_entry(const Epetra_CrsMatrix &matrix,
                     const bool              upper_only,
                     const Action           &action)
      {
        const int *column_numbers = matrix.ColMap().MyGlobalElements();
        for (int r = 0; r < matrix.NumMyRows(); ++r)
        {
          int       n;
          double   *row_values;
          int      *indices;
          const int row = matrix.RowMap().GID(r);
          matrix.ExtractMyRowView(r, n, row_values, indices);
          for (int i = 0; i < n; ++i)
            if (!upper_only || column_numbers[indices[i]] >= row)
              action(row, column_numbers[indices[i]], row_values[i]);
        }
      }

      void
      set_pattern(const Epetra_CrsMatrix &matrix, const bool upper_only)
      {
        rows.clear();
        columns.clear();
        const std::size_t n_expected =
          upper_only ? matrix.NumMyNonzeros() / 2 + matrix.NumMyRows()
                     : matrix.NumMyNonzeros();
        rows.reserve(n_expected);
        columns.reserve(n_expected);
        for_each_entry(matrix,
                       upper_only,
                       [&](const int row, const int column, double) {
                         rows.push_back(row + 1);
                         columns.push_back(column + 1);
                       });
        values.resize(rows.size());
      }

      void
      set_values(const Epetra_CrsMatrix &matrix, const bool upper_only)
      {
        std::size_t i = 0;
        for_each_entry(matrix, upper_only, [&](int, int, const double value) {
          Assert(i < values.size(), dealii::ExcInternalError());
          values[i++] = value;
        });
        AssertDimension(i, values.size());
      }

      /// An equation x = f of its own for each of @p n rows that is not of @p some.
      void
      keep(const std::vector<unsigned int> &some, const unsigned int n)
      {
        std::vector<bool> kept(n, false);
        for (const unsigned int row : some)
          kept[row] = true;
        for (std::size_t i = 0; i < values.size(); ++i)
          if (!kept[rows[i] - 1] || !kept[columns[i] - 1])
            values[i] = rows[i] == columns[i] ? 1. : 0.;
      }
    };


    namespace
    {
      /// Pieces of all ranks in their order, on the first rank.
      template <typename Number>
      void
      gather(const std::vector<Number> &local,
             const MPI_Datatype         type,
             const MPI_Comm             communicator,
             std::vector<Number>       &global)
      {
        const int              n = local.size();
        const std::vector<int> counts =
          dealii::Utilities::MPI::all_gather(communicator, n);
        std::vector<int> offsets(counts.size(), 0);
        std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
        if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
          global.resize(offsets.back() + counts.back());
        MPI_Gatherv(local.data(),
                    n,
                    type,
                    global.data(),
                    counts.data(),
                    offsets.data(),
                    type,
                    0,
                    communicator);
      }
    } // namespace


    struct DirectSolver::Data
    {
      bool is_symmetric;
      /// Null on other ranks than the first if that one does all.
      std::unique_ptr<Mumps> mumps;
      Triplets               triplets;
      /// Those of all ranks, on the first one, if that one does all.
      Triplets     all_triplets;
      unsigned int n = 0;
      MPI_Comm     communicator;
      unsigned int n_ranks;
      bool         is_analyzed   = false;
      double       analysis_time = 0.;
      /// Does the first rank do all?
      bool      is_serial = false;
      KluSolver klu;
      /// What is solved for; empty: all.
      std::vector<unsigned int> rows;
      /// Of the last factorization; null: MUMPS has them.
      Factors *factors = nullptr;
      /// See DirectSolver().
      bool   has_blocks = false;
      BodyLu body_lu;
      /// What is read of a sparse matrix; null: blocks are not for it. And what was
      /// written to one.
      std::unique_ptr<BodyMatrix>                             blocks;
      std::unique_ptr<dealii::TrilinosWrappers::SparseMatrix> of_blocks;

      void
      run(const int job, const std::string &stage)
      {
        std::array<int, 2> info = {{0, 0}};
        if (mumps)
          info = mumps->run(job);
        if (is_serial)
          info = dealii::Utilities::MPI::broadcast(communicator, info);
        check(info, stage);
      }

      void
      set_matrix(const dealii::TrilinosWrappers::SparseMatrix &matrix);

      /// Is the matrix, of which KLU then has the analysis, one for KLU?
      bool
      may_be_klus(const dealii::TrilinosWrappers::SparseMatrix &matrix);
    };


    void
    DirectSolver::Data::set_matrix(
      const dealii::TrilinosWrappers::SparseMatrix &matrix)
    {
      triplets.set_pattern(matrix.trilinos_matrix(), is_symmetric);
      if (is_serial)
      {
        gather(triplets.rows, MPI_INT, communicator, all_triplets.rows);
        gather(triplets.columns, MPI_INT, communicator, all_triplets.columns);
        all_triplets.values.resize(all_triplets.rows.size());
      }
      if (!mumps)
        return;
      DMUMPS_STRUC_C &m = mumps->data;
      m.n               = n;
      if (n_ranks > 1 && !is_serial)
      {
        mumps->control(18) = 3; // distributed entries
        m.nnz_loc          = triplets.values.size();
        m.irn_loc          = triplets.rows.data();
        m.jcn_loc          = triplets.columns.data();
        m.a_loc            = triplets.values.data();
        return;
      }
      Triplets &all = is_serial ? all_triplets : triplets;
      m.nnz         = all.values.size();
      m.irn         = all.rows.data();
      m.jcn         = all.columns.data();
      m.a           = all.values.data();
    }


    bool
    DirectSolver::Data::may_be_klus(
      const dealii::TrilinosWrappers::SparseMatrix &matrix)
    {
      // what MUMPS needs for its analysis and a factorization is worth these
      constexpr double max_work_per_unknown = 5000.;

      if (dealii::Utilities::MPI::n_mpi_processes(
            matrix.get_mpi_communicator()) > 1)
        return false;
      if (has_blocks && !is_analyzed)
        return klu.analyze(matrix, rows) <= max_work_per_unknown ||
               klu.is_suitable(matrix, rows);
      if (!klu.is_suitable(matrix, rows))
        return false;
      klu.analyze(matrix, rows);
      return true;
    }


    DirectSolver::DirectSolver(
      const Symmetry                   symmetry,
      const std::vector<unsigned int> &unknown_to_block)
      : data(std::make_unique<Data>())
    {
      data->has_blocks   = !unknown_to_block.empty();
      data->is_symmetric = symmetry == Symmetry::symmetric;
      if (BodyMatrix::is_suitable(unknown_to_block))
        data->blocks = std::make_unique<BodyMatrix>(unknown_to_block);
    }


    DirectSolver::~DirectSolver() = default;


    void
    DirectSolver::forget_analysis()
    {
      data->is_analyzed = false;
      data->mumps.reset();
    }


    void
    DirectSolver::analyze(const dealii::TrilinosWrappers::SparseMatrix &matrix)
    {
      const dealii::Timer timer;
      data->communicator = matrix.get_mpi_communicator();
      data->n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(data->communicator);
      data->n         = matrix.m();
      data->is_serial = data->n_ranks > 1 && data->n < n_distributed;
      data->mumps.reset();
      if (!data->is_serial)
        data->mumps =
          std::make_unique<Mumps>(data->communicator, data->is_symmetric);
      else if (dealii::Utilities::MPI::this_mpi_process(data->communicator) ==
               0)
        data->mumps =
          std::make_unique<Mumps>(MPI_COMM_SELF, data->is_symmetric);
      data->set_matrix(matrix);
      if (data->mumps)
        set_controls();
      data->run(1, "analysis");
      data->is_analyzed   = true;
      data->analysis_time = timer.wall_time();
    }


    double
    DirectSolver::analysis_time() const
    {
      return data->analysis_time;
    }


    void
    DirectSolver::set_controls()
    {
      Mumps &mumps = *data->mumps;
      // The order of elimination: MUMPS' approximate minimum degree (0), or its nested
      // dissection by PORD (4), which takes five times as long and pays by smaller
      // factors in large systems without joints only. Analysis, factorization and
      // solution take 1.29 and 1.27 s for 178,000 unknowns of a ring, 4.0 and 3.2 s
      // for 393,000; 2.8 and 4.0 s for 297,000 unknowns of 290 blocks that are tied to
      // each other. METIS_NodeND takes 3.7 and 3.0 s for the last two.
      constexpr unsigned int n_nested_dissection = 350000;
      mumps.control(7) = data->n < n_nested_dissection ? 0 : 4;
      // What is left last is factorized as the rest is: ScaLAPACK knows no
      // symmetric indefinite matrices, and has twice the work.
      mumps.control(13) = data->is_symmetric ? 1 : 0;
      // The diagonal is that of a stiffness matrix: no permutation for larger
      // pivots is looked for, and no compression of 2x2 pivots.
      mumps.control(6)  = 0;
      mumps.control(12) = 1;
      mumps.control(14) = 30; // percent of memory to spare
    }


    void
    DirectSolver::factorize(
      const dealii::TrilinosWrappers::SparseMatrix &matrix,
      const std::vector<unsigned int>              &rows,
      const std::vector<std::vector<unsigned int>> &couplings)
    {
      data->rows = rows;
      if (data->blocks && !couplings.empty())
      {
        std::vector<bool> is_chosen(rows.empty() ? 0
                                                 : data->blocks->n_blocks());
        for (const unsigned int row : rows)
          is_chosen[data->blocks->block_of(row)] = true;
        data->blocks->read(matrix, is_chosen, couplings);
        if (data->body_lu.factorize(*data->blocks, rows))
        {
          data->factors = &data->body_lu;
          return;
        }
      }
      factorize_entries(matrix);
    }


    void
    DirectSolver::factorize(const BodyMatrix                &matrix,
                            const std::vector<unsigned int> &rows)
    {
      data->rows = rows;
      if (data->body_lu.factorize(matrix, rows))
      {
        data->factors = &data->body_lu;
        return;
      }
      forget_analysis();
      data->of_blocks =
        std::make_unique<dealii::TrilinosWrappers::SparseMatrix>(
          matrix.sparse());
      factorize_entries(*data->of_blocks);
    }


    void
    DirectSolver::factorize_entries(
      const dealii::TrilinosWrappers::SparseMatrix &matrix)
    {
      data->factors = nullptr;
      if (data->may_be_klus(matrix))
      {
        data->klu.factorize();
        data->factors = &data->klu;
        return;
      }
      if (!data->is_analyzed)
        analyze(matrix);
      AssertDimension(matrix.m(), data->n);
      data->triplets.set_values(matrix.trilinos_matrix(), data->is_symmetric);
      if (!data->rows.empty())
        data->triplets.keep(data->rows, data->n);
      if (data->is_serial)
        gather(data->triplets.values,
               MPI_DOUBLE,
               data->communicator,
               data->all_triplets.values);
      data->run(2, "factorization");
    }


    double
    DirectSolver::n_factor_entries() const
    {
      if (data->factors != nullptr)
        return data->factors->n_factor_entries();
      double n = 0.;
      if (data->mumps)
      {
        // INFOG(29), negative: in millions
        n = data->mumps->data.infog[28];
        n = n < 0. ? -1e6 * n : n;
      }
      return data->is_serial
               ? dealii::Utilities::MPI::broadcast(data->communicator, n)
               : n;
    }


    void
    DirectSolver::solve(const dealii::TrilinosWrappers::MPI::Vector &rhs,
                        dealii::TrilinosWrappers::MPI::Vector       &solution,
                        const std::vector<bool>                     &blocks)
    {
      if (data->factors != nullptr)
      {
        data->factors->solve(rhs, solution, blocks);
        return;
      }
      // right-hand side and solution are on the host
      const int n_local = rhs.locally_owned_size();
      if (data->n_ranks == 1)
      {
        if (&rhs != &solution)
          std::copy(rhs.begin(), rhs.end(), solution.begin());
        data->mumps->data.rhs = &*solution.begin();
        data->run(3, "solution");
        return;
      }
      const MPI_Comm communicator = data->communicator;
      const bool     is_host =
        dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
      const std::vector<int> counts =
        dealii::Utilities::MPI::all_gather(communicator, n_local);
      std::vector<int> offsets(data->n_ranks, 0);
      std::partial_sum(counts.begin(), counts.end() - 1, offsets.begin() + 1);
      std::vector<double>       global(is_host ? data->n : 1);
      const std::vector<double> local(rhs.begin(), rhs.end());
      std::vector<double>       local_solution(n_local);
      MPI_Gatherv(local.data(),
                  n_local,
                  MPI_DOUBLE,
                  global.data(),
                  counts.data(),
                  offsets.data(),
                  MPI_DOUBLE,
                  0,
                  communicator);
      if (data->mumps)
        data->mumps->data.rhs = global.data();
      data->run(3, "solution");
      MPI_Scatterv(global.data(),
                   counts.data(),
                   offsets.data(),
                   MPI_DOUBLE,
                   local_solution.data(),
                   n_local,
                   MPI_DOUBLE,
                   0,
                   communicator);
      std::copy(local_solution.begin(), local_solution.end(), solution.begin());
    }
  } // namespace internal
} // namespace NMM
