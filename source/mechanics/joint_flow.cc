#include <nmm/base/exceptions.h>
#include <nmm/mechanics/joint_flow.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace NMM
{
  namespace
  {
    /// For each node, the smallest node that it is connected with.
    std::vector<unsigned int>
    components(const FlowNetwork &network)
    {
      std::vector<unsigned int> root(network.nodes.size());
      std::iota(root.begin(), root.end(), 0u);
      const auto find = [&](unsigned int n) {
        while (root[n] != n)
          n = root[n] = root[root[n]];
        return n;
      };
      for (const FlowNetwork::Link &link : network.links)
      {
        const unsigned int a = find(link.nodes[0]), b = find(link.nodes[1]);
        root[std::max(a, b)] = std::min(a, b);
      }
      for (unsigned int n = 0; n < root.size(); ++n)
        root[n] = find(n);
      return root;
    }


    /// Solves for the heads of nodes that are not @p is_fixed; those of the others are in @p heads.
    void
    solve_for_heads(const FlowNetwork         &network,
                    const std::vector<double> &conductances,
                    const std::vector<bool>   &is_fixed,
                    std::vector<double>       &heads)
    {
      std::vector<int> row(heads.size(), -1);
      int              n = 0;
      for (unsigned int k = 0; k < heads.size(); ++k)
        if (!is_fixed[k])
          row[k] = n++;
      if (n == 0)
        return;
      std::vector<Eigen::Triplet<double>> entries;
      Eigen::VectorXd                     rhs = Eigen::VectorXd::Zero(n);
      for (unsigned int l = 0; l < network.links.size(); ++l)
        for (const unsigned int end : {0u, 1u})
        {
          const unsigned int here  = network.links[l].nodes[end],
                             there = network.links[l].nodes[1 - end];
          if (row[here] < 0)
            continue;
          entries.emplace_back(row[here], row[here], conductances[l]);
          if (row[there] < 0)
            rhs[row[here]] += conductances[l] * heads[there];
          else
            entries.emplace_back(row[here], row[there], -conductances[l]);
        }
      Eigen::SparseMatrix<double> matrix(n, n);
      matrix.setFromTriplets(entries.begin(), entries.end());
      const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
      Eigen::VectorXd                                          solution;
      if (factors.info() == Eigen::Success)
        solution = factors.solve(rhs);
      AssertThrow(factors.info() == Eigen::Success && solution.allFinite(),
                  NumericalFailure("The equations of flow in joints are "
                                   "singular to rounding",
                                   "the network of joints",
                                   "raise the residual aperture, or lower the "
                                   "largest one"));
      for (unsigned int k = 0; k < heads.size(); ++k)
        if (row[k] >= 0)
          heads[k] = solution[row[k]];
    }
  } // namespace


  double
  FlowNetwork::conductance(const Link &link) const
  {
    const double b = link.apertures[0], c = link.apertures[1];
    return unit_weight / (12. * viscosity) * 2. * b * b * c * c / (b + c) /
           link.length;
  }


  NetworkFlow
  solve_flow(const FlowNetwork &network)
  {
    const unsigned int  n = network.nodes.size();
    NetworkFlow         result;
    std::vector<double> conductances;
    for (const FlowNetwork::Link &link : network.links)
      conductances.push_back(network.conductance(link));

    const std::vector<unsigned int> root = components(network);
    std::vector<bool>               is_fed(n, false), is_fixed(n, false);
    for (unsigned int k = 0; k < n; ++k)
      if (network.nodes[k].head)
        is_fed[root[k]] = true;
    double largest = 0.;
    for (unsigned int k = 0; k < n; ++k)
    {
      const FlowNetwork::Node &node = network.nodes[k];
      // Without a given head nothing drives a flow, and the joint is dry.
      const bool is_dry = !is_fed[root[k]];
      is_fixed[k]       = node.head || node.is_in_air || is_dry;
      result.n_dry += is_dry;
      result.heads.push_back(node.head.value_or(node.elevation));
      largest = std::max(largest, std::abs(result.heads[k]));
    }
    const auto inflows = [&]() {
      result.flows.clear();
      result.inflows.assign(n, 0.);
      for (unsigned int l = 0; l < network.links.size(); ++l)
      {
        const auto  &nodes = network.links[l].nodes;
        const double q =
          conductances[l] * (result.heads[nodes[0]] - result.heads[nodes[1]]);
        result.flows.push_back(q);
        result.inflows[nodes[0]] += q;
        result.inflows[nodes[1]] -= q;
      }
    };

    // Nodes in the air are at the pressure 0 at first. Those that draw water in are closed, and those
    // that are closed under a pressure are opened.
    constexpr unsigned int max_iterations = 50;
    constexpr double       rounding       = 1e-12;
    for (unsigned int iteration = 0; iteration < max_iterations; ++iteration)
    {
      solve_for_heads(network, conductances, is_fixed, result.heads);
      inflows();
      const double all         = std::accumulate(result.flows.begin(),
                                         result.flows.end(),
                                         0.,
                                         [](const double sum, const double q) {
                                           return sum + std::abs(q);
                                         });
      bool         has_changed = false;
      for (unsigned int k = 0; k < n; ++k)
      {
        const FlowNetwork::Node &node = network.nodes[k];
        if (!node.is_in_air || node.head || !is_fed[root[k]])
          continue;
        const bool is_wrong =
          is_fixed[k] ? result.inflows[k] > rounding * all
                      : result.heads[k] > node.elevation + rounding * largest;
        if (!is_wrong)
          continue;
        is_fixed[k] = !is_fixed[k];
        if (is_fixed[k])
          result.heads[k] = node.elevation;
        has_changed = true;
      }
      if (!has_changed)
        return result;
    }
    AssertThrow(false,
                NumericalFailure("The faces at which water flows out of joints "
                                 "are not found",
                                 "the network of joints",
                                 "name faces in 'Water/Impermeable', or give "
                                 "another table"));
    return result;
  }
} // namespace NMM
