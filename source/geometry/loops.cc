#include "geometry/loops.h"

#include "geometry/curve.h"
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      /// Graph whose edges are open curves and whose nodes are their end points.
      class EndGraph
      {
      public:
        EndGraph(const std::vector<Curve> &curves,
                 std::vector<unsigned int> members)
          : curves(curves)
          , members(std::move(members))
        {
          for (const unsigned int c : this->members)
          {
            ends[c] = {{node_at(curves[c].start()), node_at(curves[c].end())}};
            for (const unsigned int node : ends[c])
              node_to_curves[node].push_back(c);
          }
        }

        /// Nodes at which an odd number of curves ends.
        std::vector<unsigned int>
        loose_nodes() const
        {
          std::vector<unsigned int> loose;
          for (unsigned int n = 0; n < nodes.size(); ++n)
            if (node_to_curves[n].size() % 2 == 1)
              loose.push_back(n);
          return loose;
        }

        const dealii::Point<2> &
        location(const unsigned int node) const
        {
          return nodes[node];
        }

        const std::vector<unsigned int> &
        curves_at(const unsigned int node) const
        {
          return node_to_curves[node];
        }

        /// Cycles that visit no node twice. No node may have an odd number of curves.
        std::vector<std::vector<unsigned int>>
        cycles() const;

      private:
        unsigned int
        node_at(const dealii::Point<2> &point)
        {
          // Adding 0 turns -0 into 0.
          const auto [it, is_new] =
            point_to_node.insert({{point[0] + 0., point[1] + 0.},
                                  static_cast<unsigned int>(nodes.size())});
          if (is_new)
          {
            nodes.push_back(point);
            node_to_curves.emplace_back();
          }
          return it->second;
        }

        const std::vector<Curve>                           &curves;
        std::vector<unsigned int>                           members;
        std::vector<dealii::Point<2>>                       nodes;
        std::vector<std::vector<unsigned int>>              node_to_curves;
        std::map<unsigned int, std::array<unsigned int, 2>> ends;
        std::map<std::pair<double, double>, unsigned int>   point_to_node;
      };


      std::vector<std::vector<unsigned int>>
      EndGraph::cycles() const
      {
        std::vector<std::vector<unsigned int>> result;
        std::set<unsigned int>                 used;
        for (const unsigned int first : members)
        {
          if (used.count(first) > 0)
            continue;
          // Walk along the graph: path_nodes[i] -- path_curves[i] -- path_nodes[i+1]. When the walk
          // returns to one of its nodes, a cycle is split off.
          std::vector<unsigned int> path_nodes  = {ends.at(first)[0]};
          std::vector<unsigned int> path_curves = {first};
          unsigned int              last        = first;
          unsigned int              node        = ends.at(first)[1];
          used.insert(first);
          while (true)
          {
            const auto visited =
              std::find(path_nodes.begin(), path_nodes.end(), node);
            if (visited != path_nodes.end())
            {
              const auto n_kept = visited - path_nodes.begin();
              result.emplace_back(path_curves.begin() + n_kept,
                                  path_curves.end());
              path_curves.resize(n_kept);
              path_nodes.resize(n_kept);
              if (path_curves.empty())
                break;
            }
            path_nodes.push_back(node);

            const auto &here    = node_to_curves[node];
            const auto  is_free = [&](const unsigned int c) {
              return used.count(c) == 0;
            };
            auto next =
              std::find_if(here.begin(), here.end(), [&](const unsigned int c) {
                return c > last && is_free(c);
              });
            if (next == here.end())
              next = std::find_if(here.begin(), here.end(), is_free);
            Assert(next != here.end(), dealii::ExcInternalError());
            last = *next;
            used.insert(last);
            path_curves.push_back(last);
            const auto &next_ends = ends.at(last);
            node = next_ends[0] == node ? next_ends[1] : next_ends[0];
          }
        }
        return result;
      }


      void
      throw_open(const std::vector<Curve> &curves, const EndGraph &graph)
      {
        const std::vector<unsigned int> loose = graph.loose_nodes();
        const unsigned int              node  = loose.front();
        const dealii::Point<2>         &place = graph.location(node);
        const Curve &curve = curves[graph.curves_at(node).front()];

        unsigned int nearest  = invalid_index;
        double       distance = std::numeric_limits<double>::max();
        for (const unsigned int other : loose)
          if (other != node && graph.location(other).distance(place) < distance)
          {
            nearest  = other;
            distance = graph.location(other).distance(place);
          }
        Assert(nearest != invalid_index, dealii::ExcInternalError());

        const unsigned int n_ends = graph.curves_at(node).size();
        AssertThrow(
          false,
          InputError(
            describe(curve) + " is open: " +
              (n_ends == 1 ? "no other " + to_string(curve.role) + " ends"
                           : std::to_string(n_ends) + " ends meet") +
              " at its loose end; the nearest other loose end is " +
              describe_length(distance) + " away at " +
              to_string(graph.location(nearest)) + " on " +
              describe(curves[graph.curves_at(nearest).front()]),
            describe_place(curve, place),
            "let the two ends coincide exactly or set a cleaning tolerance "
            "larger than their distance"));
      }


      std::string
      material_of(const std::vector<Curve>        &curves,
                  const std::vector<unsigned int> &members)
      {
        std::string  material;
        unsigned int from = invalid_index;
        for (const unsigned int c : members)
          if (!curves[c].material.empty())
          {
            AssertThrow(from == invalid_index || curves[c].material == material,
                        InputError(describe(curves[from]) + " and " +
                                     describe(curves[c]) +
                                     " bound the same domain but name the "
                                     "materials '" +
                                     material + "' and '" + curves[c].material +
                                     "'",
                                   describe_place(curves[c], curves[c].start()),
                                   "name the same material or give it once"));
            material = curves[c].material;
            from     = c;
          }
        return material;
      }


      void
      add_loop(const std::vector<Curve>        &curves,
               const std::vector<unsigned int> &members,
               Loops                           &loops)
      {
        for (const unsigned int c : members)
          loops.curve_to_loop[c] = loops.loops.size();
        loops.loops.push_back({curves[members.front()].role,
                               members,
                               material_of(curves, members)});
      }
    } // namespace


    Loops
    find_loops(const std::vector<Curve> &curves)
    {
      Loops loops;
      loops.curve_to_loop.assign(curves.size(), invalid_index);

      std::vector<unsigned int> open_boundaries, open_holes;
      std::map<std::string, std::vector<unsigned int>> open_interfaces;
      for (unsigned int c = 0; c < curves.size(); ++c)
      {
        const CurveRole role = curves[c].role;
        if (role == CurveRole::joint)
          continue;
        if (curves[c].is_closed())
          add_loop(curves, {c}, loops);
        else if (role == CurveRole::boundary)
          open_boundaries.push_back(c);
        else if (role == CurveRole::hole)
          open_holes.push_back(c);
        else
          open_interfaces[curves[c].name].push_back(c);
      }

      for (const auto &members : {open_boundaries, open_holes})
      {
        const EndGraph graph(curves, members);
        if (!graph.loose_nodes().empty())
          throw_open(curves, graph);
        for (const auto &cycle : graph.cycles())
          add_loop(curves, cycle, loops);
      }
      for (const auto &[name, members] : open_interfaces)
      {
        const EndGraph graph(curves, members);
        if (graph.loose_nodes().empty())
          for (const auto &cycle : graph.cycles())
            add_loop(curves, cycle, loops);
      }

      for (unsigned int c = 0; c < curves.size(); ++c)
        AssertThrow(curves[c].role != CurveRole::interface ||
                      curves[c].material.empty() ||
                      loops.curve_to_loop[c] != invalid_index,
                    InputError(describe(curves[c]) + " names the material '" +
                                 curves[c].material +
                                 "' but is open, so nothing is inside it",
                               describe_place(curves[c], curves[c].start()),
                               "close it or use a material point"));
      return loops;
    }
  } // namespace internal
} // namespace NMM
