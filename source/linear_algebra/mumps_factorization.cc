#include <nmm/base/exceptions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <Epetra_CrsMatrix.h>
#include <algorithm>
#include <array>
#include <dmumps_c.h>
#include <linear_algebra/mumps_factorization.h>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      using dealii::Utilities::MPI::this_mpi_process;

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


      /// Number of values of each rank, and the index of the first of them among those of all
      /// ranks.
      struct Layout
      {
        Layout(const int n_local, const MPI_Comm communicator)
          : counts(dealii::Utilities::MPI::all_gather(communicator, n_local))
          , offsets(counts.size(), 0)
        {
          std::partial_sum(counts.begin(),
                           counts.end() - 1,
                           offsets.begin() + 1);
        }

        std::vector<int> counts, offsets;
      };


      /// Collect the values of all ranks, in the order of ranks, on the first rank.
      template <typename Number>
      void
      gather(const std::vector<Number> &local,
             const MPI_Datatype         type,
             const MPI_Comm             communicator,
             std::vector<Number>       &global)
      {
        const Layout layout(local.size(), communicator);
        if (this_mpi_process(communicator) == 0)
          global.resize(layout.offsets.back() + layout.counts.back());
        MPI_Gatherv(local.data(),
                    local.size(),
                    type,
                    global.data(),
                    layout.counts.data(),
                    layout.offsets.data(),
                    type,
                    0,
                    communicator);
      }


    } // namespace


    /// One MUMPS instance.
    class Mumps
    {
    public:
      Mumps(const MPI_Comm communicator, const bool is_symmetric)
        : data()
      {
        data.comm_fortran = MPI_Comm_c2f(communicator);
        data.par          = 1; // the host computes too
        // Symmetric (2), not positive definite (1): a matrix that is indefinite because of
        // rounding is then factorized, and noticed by its residual instead of an error.
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

      /// ICNTL(i) of the manual.
      MUMPS_INT &
      control(const int i)
      {
        return data.icntl[i - 1];
      }

      /// Run a stage. Returns the error code and its parameter.
      std::array<int, 2>
      run(const int job)
      {
        data.job = job;
        dmumps_c(&data);
        return {{data.infog[0], data.infog[1]}};
      }

      DMUMPS_STRUC_C data;
    };


    /// A matrix as row numbers, column numbers (both counted from 1) and values. Of a symmetric
    /// matrix only the upper triangle is stored.
    struct Triplets
    {
      std::vector<MUMPS_INT> rows, columns;
      std::vector<double>    values;

      /// Call action(row, column, value) for each entry that is stored as a triplet.
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

      /// Replace all but @p chosen of @p n rows and columns by those of the
      /// identity.
      void
      keep(const std::vector<unsigned int> &chosen, const unsigned int n)
      {
        std::vector<bool> kept(n, false);
        for (const unsigned int row : chosen)
          kept[row] = true;
        for (std::size_t i = 0; i < values.size(); ++i)
          if (!kept[rows[i] - 1] || !kept[columns[i] - 1])
            values[i] = rows[i] == columns[i] ? 1. : 0.;
      }
    };


    struct MumpsFactorization::Data
    {
      /// Memory for the factors beyond what the analysis predicts [%].
      static constexpr int normal_reserve = 30;

      bool is_symmetric;
      /// Null before the analysis, and on all ranks except the first one if the first one
      /// factorizes alone.
      std::unique_ptr<Mumps> mumps;
      bool                   is_analyzed   = false;
      double                 analysis_time = 0.;
      unsigned int           n             = 0;
      MPI_Comm               communicator;
      unsigned int           n_ranks = 1;
      /// Whether the first of several ranks factorizes alone.
      bool is_serial = false;
      /// Entries of this rank; and, on the first rank if it factorizes alone, those of all ranks.
      Triplets triplets, all_triplets;

      /// Run a job and return MUMPS' INFOG(1) and INFOG(2).
      std::array<int, 2>
      try_to_run(const int job)
      {
        std::array<int, 2> info = {{0, 0}};
        if (mumps)
          info = mumps->run(job);
        if (is_serial)
          info = dealii::Utilities::MPI::broadcast(communicator, info);
        return info;
      }

      void
      run(const int job, const std::string &stage)
      {
        check(try_to_run(job), stage);
      }

      /// Factorize. Delayed pivots may need more memory than the analysis has predicted; then
      /// the factorization is repeated with twice the reserve, as often as necessary.
      void
      run_factorization()
      {
        constexpr int      too_little_memory = -9;
        constexpr int      largest_reserve   = 1000; // [%]
        const auto         factorization = [this]() { return try_to_run(2); };
        std::array<int, 2> info          = factorization();
        for (int reserve = 2 * normal_reserve;
             info[0] == too_little_memory && reserve <= largest_reserve;
             reserve *= 2)
        {
          if (mumps)
            mumps->control(14) = reserve;
          info = factorization();
        }
        check(info, "factorization");
      }

      void
      set_pattern(const Epetra_CrsMatrix &matrix);

      void
      set_controls();

      void
      analyze(const Matrix &matrix);
    };


    void
    MumpsFactorization::Data::set_pattern(const Epetra_CrsMatrix &matrix)
    {
      triplets.set_pattern(matrix, is_symmetric);
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


    void
    MumpsFactorization::Data::set_controls()
    {
      // The order of elimination is MUMPS' approximate minimum degree (0) or its nested
      // dissection by PORD (4). The latter takes five times as long to compute. Its smaller
      // factors compensate for this in large systems without joints only. Analysis,
      // factorization and solution together take, with (0) and (4): 1.29 and 1.27 s for 178,000
      // unknowns of a ring; 4.0 and 3.2 s for 393,000; 2.8 and 4.0 s for 297,000 unknowns of 290
      // blocks that are tied to each other. METIS_NodeND takes 3.7 and 3.0 s for the last two.
      constexpr unsigned int n_nested_dissection = 350000;
      // Unsymmetric matrices come from contact with friction, where approximate
      // minimum fill (2) makes smaller factors: the load steps of jointed-tunnel.prm take 10.8
      // instead of 11.8 s.
      mumps->control(7) = n >= n_nested_dissection ? 4 : is_symmetric ? 0 : 2;
      // The root front of a symmetric matrix is factorized like the others, and not by ScaLAPACK,
      // which has no symmetric indefinite factorization and would do twice the work.
      mumps->control(13) = is_symmetric ? 1 : 0;
      // The diagonal is that of a stiffness matrix: neither a permutation for larger
      // pivots nor a compression for 2 x 2 pivots is needed.
      mumps->control(6)  = 0;
      mumps->control(12) = 1;
      mumps->control(14) = normal_reserve;
    }


    void
    MumpsFactorization::Data::analyze(const Matrix &matrix)
    {
      const dealii::Timer timer;
      communicator = matrix.get_mpi_communicator();
      n_ranks      = dealii::Utilities::MPI::n_mpi_processes(communicator);
      n            = matrix.m();
      is_serial    = n_ranks > 1 && n < n_distributed;
      mumps.reset();
      if (!is_serial)
        mumps = std::make_unique<Mumps>(communicator, is_symmetric);
      else if (this_mpi_process(communicator) == 0)
        mumps = std::make_unique<Mumps>(MPI_COMM_SELF, is_symmetric);
      set_pattern(matrix.trilinos_matrix());
      if (mumps)
        set_controls();
      run(1, "analysis");
      is_analyzed   = true;
      analysis_time = timer.wall_time();
    }


    MumpsFactorization::MumpsFactorization(const bool is_symmetric)
      : data(std::make_unique<Data>())
    {
      data->is_symmetric = is_symmetric;
    }


    MumpsFactorization::~MumpsFactorization() = default;


    void
    MumpsFactorization::forget_analysis()
    {
      data->is_analyzed = false;
      data->mumps.reset();
    }


    bool
    MumpsFactorization::is_analyzed() const
    {
      return data->is_analyzed;
    }


    double
    MumpsFactorization::analysis_time() const
    {
      return data->analysis_time;
    }


    bool
    MumpsFactorization::factorize(const Matrix                    &matrix,
                                  const std::vector<unsigned int> &rows)
    {
      Data &d = *data;
      if (!d.is_analyzed)
        d.analyze(matrix);
      AssertDimension(matrix.m(), d.n);
      d.triplets.set_values(matrix.trilinos_matrix(), d.is_symmetric);
      if (!rows.empty())
        d.triplets.keep(rows, d.n);
      if (d.is_serial)
        gather(d.triplets.values,
               MPI_DOUBLE,
               d.communicator,
               d.all_triplets.values);
      d.run_factorization();
      return true;
    }


    double
    MumpsFactorization::n_factor_entries() const
    {
      double n = 0.;
      if (data->mumps)
      {
        // INFOG(29) is the number of entries, or minus that number in millions
        n = data->mumps->data.infog[28];
        n = n < 0. ? -1e6 * n : n;
      }
      return data->is_serial
               ? dealii::Utilities::MPI::broadcast(data->communicator, n)
               : n;
    }


    void
    MumpsFactorization::solve(const Vector &rhs,
                              Vector       &solution,
                              const std::vector<bool> & /*bodies*/)
    {
      Data &d = *data;
      if (d.n_ranks == 1)
      {
        if (&rhs != &solution)
          std::copy(rhs.begin(), rhs.end(), solution.begin());
        d.mumps->data.rhs  = &*solution.begin();
        d.mumps->data.nrhs = 1;
        d.run(3, "solution");
        return;
      }
      std::vector<Vector> vectors(1, rhs);
      solve_all(vectors);
      solution = vectors[0];
    }


    void
    MumpsFactorization::solve_all(std::vector<Vector> &vectors)
    {
      Data &d = *data;
      // right-hand sides and solutions are on the first rank
      std::vector<double> all, global(1);
      for (const Vector &vector : vectors)
      {
        gather(std::vector<double>(vector.begin(), vector.end()),
               MPI_DOUBLE,
               d.communicator,
               global);
        all.insert(all.end(), global.begin(), global.end());
      }
      if (d.mumps)
      {
        d.mumps->data.rhs  = all.data();
        d.mumps->data.nrhs = vectors.size();
        d.mumps->data.lrhs = d.n;
      }
      d.run(3, "solution");
      for (unsigned int i = 0; i < vectors.size(); ++i)
      {
        std::vector<double> local(vectors[i].locally_owned_size());
        const Layout        layout(local.size(), d.communicator);
        MPI_Scatterv(all.data() + i * global.size(),
                     layout.counts.data(),
                     layout.offsets.data(),
                     MPI_DOUBLE,
                     local.data(),
                     local.size(),
                     MPI_DOUBLE,
                     0,
                     d.communicator);
        std::copy(local.begin(), local.end(), vectors[i].begin());
      }
    }
  } // namespace internal
} // namespace NMM
