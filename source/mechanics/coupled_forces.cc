#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <mechanics/coupled_forces.h>
#include <utility>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Whether unknowns are pairs, those of this rank free ones.
      [[maybe_unused]] bool
      are_free_pairs(const CoupledForces::Unknowns &unknowns,
                     const ModelLayout             &layout)
      {
        bool result = unknowns.size() % 2 == 0;
        for (unsigned int i = 0; i < unknowns.size(); ++i)
          result = result && component_of(unknowns[i]) == component_of(i) &&
                   cover_of(unknowns[i]) ==
                     cover_of(unknowns[unknown_of(cover_of(i), 0)]) &&
                   !(layout.locally_owned.is_element(unknowns[i]) &&
                     layout.constraints->is_constrained(unknowns[i]));
        return result;
      }
    } // namespace


    CoupledForces::CoupledForces(const ModelLayout    &layout,
                                 std::vector<Unknowns> couplings)
      : layout(&layout)
      , matrix(std::move(couplings))
    {
      residual.reinit(layout.locally_owned, layout.communicator);
    }


    void
    CoupledForces::begin(const Trial &trial, AssembledForces &sum)
    {
      with_tangent = trial.tangent != Tangent::none;
      begins.assign(1, 0);
      unknowns.clear();
      forces.clear();
      tangents.clear();
      sum.sink = this;
      if (!trial.blocks().empty() && rows.empty())
        rows.reinit(layout->blocks_of_unknowns);
      rows.select(trial.blocks());
    }


    void
    CoupledForces::add_unknowns(const Unknowns &of_forces)
    {
      Assert(are_free_pairs(of_forces, *layout),
             dealii::ExcMessage(
               "Forces act on pairs of free unknowns 2k and 2k + 1."));
      unknowns.insert(unknowns.end(), of_forces.begin(), of_forces.end());
      begins.push_back(unknowns.size());
    }


    void
    CoupledForces::add(const Unknowns                   &of_forces,
                       const dealii::Vector<double>     &added,
                       const dealii::FullMatrix<double> &tangent)
    {
      const unsigned int n = of_forces.size();
      AssertDimension(added.size(), n);
      add_unknowns(of_forces);
      forces.insert(forces.end(), added.begin(), added.end());
      if (!with_tangent)
        return;
      AssertDimension(tangent.m(), n);
      AssertDimension(tangent.n(), n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          tangents.push_back(tangent(i, j));
    }


    void
    CoupledForces::add(const MaterialVector       &d,
                       const dealii::Tensor<1, 2> &force,
                       const dealii::Tensor<2, 2> &stiffness)
    {
      add_unknowns(d.unknowns);
      for (const dealii::Tensor<1, 2> &row : d.weights)
      {
        forces.push_back(row * force);
        for (unsigned int j = 0; with_tangent && j < d.weights.size(); ++j)
          tangents.push_back(row * (stiffness * d.weights[j]));
      }
    }


    void
    CoupledForces::finish(AssembledForces &sum)
    {
      add_residual(sum);
      if (with_tangent && sum.body_tangent != nullptr)
        add_body_tangent(sum);
      else if (with_tangent)
        add_tangent(sum);
    }


    void
    CoupledForces::add_residual(AssembledForces &sum)
    {
      const auto to   = residual.begin();
      const auto from = std::as_const(*sum.residual).begin();
      rows.for_each(residual.locally_owned_size(),
                    [&](const unsigned int i) { to[i] = from[i]; });
      double square = 0.;
      for (unsigned int i = 0; i < unknowns.size(); ++i)
      {
        if (!layout->locally_owned.is_element(unknowns[i]))
          continue;
        const unsigned int row =
          layout->locally_owned.index_within_set(unknowns[i]);
        if (!rows.contains(row))
          continue;
        to[row] += forces[i];
        square += forces[i] * forces[i];
      }
      square       = dealii::Utilities::MPI::sum(square, layout->communicator);
      sum.residual = &residual;
      sum.scale    = std::hypot(sum.scale, std::sqrt(square));
    }


    template <typename Action>
    void
    CoupledForces::for_each_matrix(const Action &action) const
    {
      const double *values = tangents.data();
      for (unsigned int l = 0; l + 1 < begins.size(); ++l)
      {
        const unsigned int n = begins[l + 1] - begins[l];
        action(unknowns.data() + begins[l], n, values);
        values += std::size_t(n) * n;
      }
    }


    void
    CoupledForces::add_body_tangent(AssembledForces &sum)
    {
      BodyMatrix &bodies = *sum.body_tangent;
      (void)set_version(&bodies, sum);
      std::vector<unsigned int> covers;
      for_each_matrix([&](const dealii::types::global_dof_index *first,
                          const unsigned int                     n,
                          const double                          *values) {
        covers.clear();
        for (unsigned int i = 0; i < n; i += 2)
          covers.push_back(cover_of(first[i]));
        bodies.add({covers.data(), covers.size()}, values);
      });
    }


    void
    CoupledForces::add_tangent(AssembledForces &sum)
    {
      const Matrix &of_terms = *sum.tangent;
      if (set_version(&of_terms, sum))
        matrix.build(of_terms, layout->locally_owned, layout->communicator);
      matrix.read(of_terms, rows);
      for_each_matrix(
        [&](const dealii::types::global_dof_index *first,
            const unsigned int                     n,
            const double *values) { matrix.add(first, n, values, rows); });
      sum.tangent = sum.writable_tangent = &matrix.matrix();
    }


    /// Set the version of the pattern that the sum gets here. Returns whether the pattern of the
    /// matrix that the terms have written is another one than before.
    bool
    CoupledForces::set_version(const void *of_terms, AssembledForces &sum)
    {
      const bool is_new =
        original != of_terms || original_version != sum.pattern_version;
      if (is_new)
        ++version;
      original            = of_terms;
      original_version    = sum.pattern_version;
      sum.pattern_version = version;
      return is_new;
    }
  } // namespace internal
} // namespace NMM
