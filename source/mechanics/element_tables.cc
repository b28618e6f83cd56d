#include <cmath>
#include <mechanics/element_tables.h>

namespace NMM
{
  namespace internal
  {
    ElementTables::ElementTables(const CoverSystem          &covers,
                                 const QuadratureCollection &quadrature)
      : first_element(covers.locally_owned_elements().first)
      , n_per_cell(
          covers.manifold_mesh().mathematical_mesh().n_covers_per_cell())
    {
      const ManifoldMesh     &mesh              = covers.manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      const unsigned int      degree            = mathematical_mesh.degree();
      const auto [first, last] = covers.locally_owned_elements();
      entries.reserve(last - first);

      // A table that elements share. Jacobians count as equal if they agree to the rounding of the
      // coordinates.
      struct Shared
      {
        dealii::Tensor<2, 2> jacobian;
        std::size_t          first;
      };
      std::vector<Shared> shared;
      constexpr double    tolerance    = 1e-10;
      constexpr unsigned  n_max_shared = 64;
      for (unsigned int e = first; e < last; ++e)
      {
        const dealii::Tensor<2, 2> jacobian =
          mathematical_mesh.jacobian(mesh.cell(e));
        const dealii::Quadrature<2> &rule  = quadrature.rule(e);
        std::size_t                  begin = weights.size();
        bool                         found = false;
        if (mesh.is_whole(e))
        {
          const double limit = tolerance * tolerance * jacobian.norm_square();
          // search backwards, because the last table is the most likely one
          for (auto s = shared.rbegin(); s != shared.rend() && !found; ++s)
            if ((s->jacobian - jacobian).norm_square() < limit)
            {
              begin = s->first;
              found = true;
            }
          // the limit avoids long searches in a mesh from a file without equal cells
          if (!found && shared.size() < n_max_shared)
            shared.push_back({jacobian, begin});
        }
        if (!found)
          append(rule, jacobian, degree);
        entries.push_back({rule.size(), begin});
      }
    }


    std::size_t
    ElementTables::append(const dealii::Quadrature<2> &rule,
                          const dealii::Tensor<2, 2>  &jacobian,
                          const unsigned int           degree)
    {
      const std::size_t          begin = weights.size();
      const double               det   = dealii::determinant(jacobian);
      const dealii::Tensor<2, 2> T =
        dealii::transpose(dealii::invert(jacobian));
      double g[WeightFunctions::max_per_cell][2];
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        weights.push_back(det * rule.weight(q));
        WeightFunctions::gradients(degree, rule.point(q), g);
        for (unsigned int i = 0; i < n_per_cell; ++i)
          for (unsigned int d = 0; d < 2; ++d)
            gradients.push_back(T[d][0] * g[i][0] + T[d][1] * g[i][1]);
      }
      return begin;
    }
  } // namespace internal
} // namespace NMM
