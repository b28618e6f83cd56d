#include <Eigen/Dense>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Vector.h>
#include <algorithm>
#include <linear_algebra/cover_smoother.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Sum of products of 2 x 2 entries with pairs of a vector's values. The four products of an
      /// entry are computed at once, by vector instructions.
      class Sum
      {
      public:
        void
        add(const float *entry, const float *x)
        {
          sum += Eigen::Map<const Eigen::Array4f>(entry) *
                 Eigen::Array4f(x[0], x[1], x[0], x[1]);
        }

        float
        operator[](const unsigned int c) const
        {
          return sum[2 * c] + sum[2 * c + 1];
        }

      private:
        Eigen::Array4f sum = Eigen::Array4f::Zero();
      };
    } // namespace


    CoverSmoother::CoverSmoother(
      const Epetra_CrsMatrix                  &matrix,
      const CoverSystem                       &covers,
      const dealii::AffineConstraints<double> &constraints)
      : matrix(&matrix)
    {
      read(matrix);
      invert_diagonals();
      make_patches(covers, constraints);
    }


    unsigned int
    CoverSmoother::n_owned() const
    {
      return n_rows;
    }


    unsigned int
    CoverSmoother::n_columns() const
    {
      return n_all;
    }


    void
    CoverSmoother::read(const Epetra_CrsMatrix &matrix)
    {
      n_rows = matrix.NumMyRows() / 2;
      n_all  = matrix.NumMyCols() / 2;
      row_begin.reserve(n_rows + 1);
      row_begin.push_back(0);
      columns.reserve(matrix.NumMyNonzeros() / 4);
      values.reserve(matrix.NumMyNonzeros());
      for (unsigned int r = 0; r < n_rows; ++r)
      {
        int     n, n_second, *indices;
        double *first, *second;
        matrix.ExtractMyRowView(unknown_of(r, 0), n, first, indices);
        matrix.ExtractMyRowView(unknown_of(r, 1), n_second, second);
        AssertDimension(n, n_second);
        diagonal.push_back(invalid_index);
        for (int i = 0; i < n; i += 2)
        {
          Assert(component_of(indices[i]) == 0 &&
                   indices[i + 1] == indices[i] + 1,
                 dealii::ExcInternalError());
          const unsigned int column = cover_of(indices[i]);
          if (column == r)
            diagonal.back() = columns.size();
          columns.push_back(column);
          for (const double *row : {first, second})
            for (unsigned int c = 0; c < 2; ++c)
              values.push_back(row[i + c]);
        }
        Assert(diagonal.back() != invalid_index, dealii::ExcInternalError());
        Assert(std::is_sorted(columns.begin() + row_begin[r], columns.end()),
               dealii::ExcInternalError());
        row_begin.push_back(columns.size());
        owned_end.push_back(std::lower_bound(columns.begin() + row_begin[r],
                                             columns.end(),
                                             n_rows) -
                            columns.begin());
      }
    }


    void
    CoverSmoother::invert_diagonals()
    {
      if (n_all > n_rows)
        addition.assign(2 * n_rows, 0.F);
      inverse_diagonal.resize(4 * n_rows);
      for (unsigned int r = 0; r < n_rows; ++r)
      {
        for (unsigned int i = owned_end[r]; i < row_begin[r + 1]; ++i)
          for (unsigned int c = 0; c < 4; ++c)
            addition[unknown_of(r, c / 2)] +=
              0.5F * std::abs(values[4 * i + c]);
        const float *a        = values.data() + 4 * diagonal[r];
        const double extra[2] = {addition.empty() ? 0.
                                                  : addition[unknown_of(r, 0)],
                                 addition.empty() ? 0.
                                                  : addition[unknown_of(r, 1)]};
        const double a00 = a[0] + extra[0], a11 = a[3] + extra[1],
                     a01         = 0.5 * (double(a[1]) + a[2]),
                     determinant = a00 * a11 - a01 * a01;
        float *inverse           = inverse_diagonal.data() + 4 * r;
        inverse[0]               = a11 / determinant;
        inverse[3]               = a00 / determinant;
        inverse[1] = inverse[2] = -a01 / determinant;
      }
    }


    void
    CoverSmoother::make_patches(
      const CoverSystem                       &covers,
      const dealii::AffineConstraints<double> &constraints)
    {
      const ManifoldMesh &mesh = covers.manifold_mesh();
      const auto [first, last] = covers.locally_owned_elements();
      const unsigned int first_cover =
        n_rows > 0 ? covers.locally_owned_covers().nth_index_in_set(0) : 0;
      std::vector<unsigned int> rows;
      const auto                add = [&](const unsigned int cover) {
        if (cover >= first_cover && cover < first_cover + n_rows)
          rows.push_back(cover - first_cover);
      };
      for (unsigned int e = first; e < last; ++e)
      {
        if (mesh.is_whole(e))
          continue;
        rows.clear();
        for (const unsigned int cover : covers.covers(e))
        {
          bool is_free = true;
          for (unsigned int c = 0; c < 2; ++c)
            if (const auto *entries =
                  constraints.get_constraint_entries(unknown_of(cover, c)))
            {
              is_free = false;
              for (const auto &entry : *entries)
                add(cover_of(entry.first));
            }
          if (is_free)
            add(cover);
        }
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        add_patch(rows);
      }
    }


    void
    CoverSmoother::add_patch(const std::vector<unsigned int> &rows)
    {
      // Added to the scaled diagonal, which is 1, so that single precision suffices for the
      // inverse of a nearly singular patch.
      constexpr double shift = 1e-5;
      // Gauss-Seidel is sufficient for patches whose scaled inverse has a smaller norm.
      constexpr double least_norm = 4.;
      if (rows.size() < 2)
        return;
      const unsigned int n = 2 * rows.size();
      Eigen::MatrixXd    local(n, n);
      local.setZero();
      for (unsigned int i = 0; i < rows.size(); ++i)
      {
        unsigned int j = 0;
        for (unsigned int k = row_begin[rows[i]]; k < owned_end[rows[i]]; ++k)
        {
          while (j < rows.size() && rows[j] < columns[k])
            ++j;
          if (j < rows.size() && rows[j] == columns[k])
            for (unsigned int c = 0; c < 4; ++c)
              local(unknown_of(i, c / 2), unknown_of(j, c % 2)) =
                values[4 * k + c];
        }
        if (!addition.empty())
          for (unsigned int c = 0; c < 2; ++c)
            local(unknown_of(i, c), unknown_of(i, c)) +=
              addition[unknown_of(rows[i], c)];
      }
      const Eigen::VectorXd scaling =
        local.diagonal().cwiseSqrt().cwiseInverse();
      local = scaling.asDiagonal() * local * scaling.asDiagonal();
      local.diagonal().array() += shift;
      const Eigen::LLT<Eigen::MatrixXd> factorization(local);
      // the smoother requires a positive definite matrix
      if (factorization.info() != Eigen::Success)
        return;
      local = factorization.solve(Eigen::MatrixXd::Identity(n, n));
      if (local.cwiseAbs().rowwise().sum().maxCoeff() < least_norm)
        return;
      local = scaling.asDiagonal() * local * scaling.asDiagonal();

      Patch patch;
      patch.begin = patch_rows.size();
      patch_rows.insert(patch_rows.end(), rows.begin(), rows.end());
      patch.end     = patch_rows.size();
      patch.inverse = patch_inverses.size();
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          patch_inverses.push_back(0.5 * (local(i, j) + local(j, i)));
      patches.push_back(patch);
      if (patch_residual.size() < n)
      {
        patch_residual.resize(n);
        patch_solution.resize(n);
      }
    }


    void
    CoverSmoother::solve_patch(const Patch &patch,
                               const float *r,
                               float       *product) const
    {
      const unsigned int n       = 2 * (patch.end - patch.begin);
      const float       *inverse = patch_inverses.data() + patch.inverse;
      std::fill(product, product + n, 0.F);
      // the inverse is symmetric: summing over its columns can be vectorized
      for (unsigned int j = 0; j < n; ++j, inverse += n)
        for (unsigned int i = 0; i < n; ++i)
          product[i] += inverse[i] * r[j];
    }


    void
    CoverSmoother::update_ghosts(std::vector<float> &x)
    {
      const Epetra_Import *importer = matrix->Importer();
      if (importer == nullptr)
        return;
      Epetra_Vector owned(matrix->RowMap()), all(matrix->ColMap());
      std::copy(x.begin(), x.begin() + 2 * n_rows, owned.Values());
      all.Import(owned, *importer, Insert);
      std::copy(all.Values() + 2 * n_rows,
                all.Values() + 2 * n_all,
                x.begin() + 2 * n_rows);
    }


    void
    CoverSmoother::pre_smooth(const std::vector<float> &rhs,
                              std::vector<float>       &x,
                              std::vector<float>       &residual)
    {
      // (D + L) x = b
      for (unsigned int r = 0; r < n_rows; ++r)
      {
        Sum sum;
        for (unsigned int i = row_begin[r]; i < diagonal[r]; ++i)
          sum.add(values.data() + 4 * i, x.data() + unknown_of(columns[i], 0));
        const float s0      = rhs[unknown_of(r, 0)] - sum[0],
                    s1      = rhs[unknown_of(r, 1)] - sum[1];
        const float *d      = inverse_diagonal.data() + 4 * r;
        x[unknown_of(r, 0)] = d[0] * s0 + d[1] * s1;
        x[unknown_of(r, 1)] = d[2] * s0 + d[3] * s1;
      }
      // b - (L + D + U) x = -U x
      for (unsigned int r = 0; r < n_rows; ++r)
      {
        Sum sum;
        for (unsigned int i = diagonal[r] + 1; i < owned_end[r]; ++i)
          sum.add(values.data() + 4 * i, x.data() + unknown_of(columns[i], 0));
        residual[unknown_of(r, 0)] = -sum[0];
        residual[unknown_of(r, 1)] = -sum[1];
      }
      for (const Patch &patch : patches)
      {
        const unsigned int *rows = patch_rows.data() + patch.begin;
        const unsigned int  n    = patch.end - patch.begin;
        for (unsigned int i = 0; i < 2 * n; ++i)
          patch_residual[i] =
            residual[unknown_of(rows[cover_of(i)], component_of(i))];
        solve_patch(patch, patch_residual.data(), patch_solution.data());
        for (unsigned int k = 0; k < n; ++k)
        {
          const unsigned int r  = rows[k];
          const float        y0 = patch_solution[unknown_of(k, 0)],
                      y1        = patch_solution[unknown_of(k, 1)];
          x[unknown_of(r, 0)] += y0;
          x[unknown_of(r, 1)] += y1;
          // the matrix is symmetric: the column is read from the row
          for (unsigned int i = row_begin[r]; i < owned_end[r]; ++i)
          {
            const float *a = values.data() + 4 * i;
            float       *s = residual.data() + unknown_of(columns[i], 0);
            s[0] -= a[0] * y0 + a[2] * y1;
            s[1] -= a[1] * y0 + a[3] * y1;
          }
          if (!addition.empty())
          {
            residual[unknown_of(r, 0)] -= addition[unknown_of(r, 0)] * y0;
            residual[unknown_of(r, 1)] -= addition[unknown_of(r, 1)] * y1;
          }
        }
      }
      if (addition.empty())
        return;

      // So far the residual contains this rank's columns only, and the changed diagonal.
      update_ghosts(x);
      for (unsigned int r = 0; r < n_rows; ++r)
        if (owned_end[r] < row_begin[r + 1])
        {
          Sum sum;
          for (unsigned int i = owned_end[r]; i < row_begin[r + 1]; ++i)
            sum.add(values.data() + 4 * i,
                    x.data() + unknown_of(columns[i], 0));
          for (unsigned int c = 0; c < 2; ++c)
            residual[unknown_of(r, c)] +=
              addition[unknown_of(r, c)] * x[unknown_of(r, c)] - sum[c];
        }
    }


    void
    CoverSmoother::residual_of_row(const unsigned int        row,
                                   const std::vector<float> &rhs,
                                   const std::vector<float> &x,
                                   float                    *residual) const
    {
      Sum sum;
      for (unsigned int i = row_begin[row]; i < row_begin[row + 1]; ++i)
        sum.add(values.data() + 4 * i, x.data() + unknown_of(columns[i], 0));
      for (unsigned int c = 0; c < 2; ++c)
      {
        residual[c] = rhs[unknown_of(row, c)] - sum[c];
        if (!addition.empty())
          residual[c] -= addition[unknown_of(row, c)] *
                         (x[unknown_of(row, c)] - start[unknown_of(row, c)]);
      }
    }


    void
    CoverSmoother::post_smooth(const std::vector<float> &rhs,
                               std::vector<float>       &x)
    {
      update_ghosts(x);
      // the addition to the diagonal multiplies the change of x by this smoother only
      if (!addition.empty())
        start.assign(x.begin(), x.begin() + 2 * n_rows);
      for (auto patch = patches.rbegin(); patch != patches.rend(); ++patch)
      {
        const unsigned int *rows = patch_rows.data() + patch->begin;
        const unsigned int  n    = patch->end - patch->begin;
        for (unsigned int k = 0; k < n; ++k)
          residual_of_row(rows[k],
                          rhs,
                          x,
                          patch_residual.data() + unknown_of(k, 0));
        solve_patch(*patch, patch_residual.data(), patch_solution.data());
        for (unsigned int i = 0; i < 2 * n; ++i)
          x[unknown_of(rows[cover_of(i)], component_of(i))] +=
            patch_solution[i];
      }
      for (unsigned int r = n_rows; r-- > 0;)
      {
        float residual[2];
        residual_of_row(r, rhs, x, residual);
        const float *d = inverse_diagonal.data() + 4 * r;
        x[unknown_of(r, 0)] += d[0] * residual[0] + d[1] * residual[1];
        x[unknown_of(r, 1)] += d[2] * residual[0] + d[3] * residual[1];
      }
    }
  } // namespace internal
} // namespace NMM
