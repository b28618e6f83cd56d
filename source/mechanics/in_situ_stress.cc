#include <nmm/base/exceptions.h>
#include <nmm/covers/point_location.h>
#include <nmm/mechanics/in_situ_stress.h>
#include <nmm/mechanics/water.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <utility>

namespace NMM
{
  using dealii::Point;

  namespace
  {
    /**
     * The weight on verticals through a solid. The boundary of each region contributes its edges with
     * the sign of the side on which the region lies. Along a vertical from above, the unit weight at a
     * place is then the sum of the signed unit weights of the edges above it. Edges between regions
     * of the same weight are left out where both sides are known to be there.
     */
    class Overburden
    {
    public:
      Overburden(const InSituStress      &stress,
                 const ManifoldMesh      &mesh,
                 const ElasticityProblem &problem);

      /// Vertical stress at @p x [Pa], not positive.
      double
      vertical_stress(const Point<2> &x) const;

    private:
      /// A piece of an edge between two abscissae, an upper or lower part of a circle if it has a
      /// radius.
      struct Piece
      {
        Point<2> left, right, center;
        double   radius;
        /// Change of the unit weight for who goes down across the piece [N/m^3].
        double change;

        double
        elevation(double x) const;
      };

      void
      add(const ElementEdge &edge, double unit_weight);

      void
      add_piece(const Point<2>    &start,
                const Point<2>    &end,
                const ElementEdge &edge,
                double             unit_weight);

      void
      sort_into_buckets();

      std::size_t
      bucket(const double x) const
      {
        const double share = (x - least) / (largest - least) * buckets.size();
        return std::min<double>(buckets.size() - 1., std::max(0., share));
      }

      /// Elevations and changes of the unit weight on a vertical, downwards.
      std::vector<std::pair<double, double>>
      crossings(double x) const;

      /// Elevation of the ground line [m]; empty: there is none.
      std::function<double(double)>          ground;
      double                                 weight_above;
      double                                 largest_weight = 0.;
      double                                 least, largest;
      std::vector<Piece>                     pieces;
      std::vector<std::vector<unsigned int>> buckets;
    };


    double
    Overburden::Piece::elevation(const double x) const
    {
      const double share = (x - left[0]) / (right[0] - left[0]);
      if (radius == 0.)
        return left[1] + share * (right[1] - left[1]);
      const double run  = x - center[0];
      const double rise = std::sqrt(std::max(0., radius * radius - run * run));
      // The chord tells which half of the circle it is, as the pieces do not turn back.
      return 0.5 * (left[1] + right[1]) > center[1] ? center[1] + rise
                                                    : center[1] - rise;
    }


    Overburden::Overburden(const InSituStress      &stress,
                           const ManifoldMesh      &mesh,
                           const ElasticityProblem &problem)
      : ground(stress.ground_line.empty()
                 ? std::function<double(double)>()
                 : line_by_points(stress.ground_line, "the ground line"))
      , weight_above(stress.unit_weight_above)
      , least(std::numeric_limits<double>::max())
      , largest(std::numeric_limits<double>::lowest())
    {
      std::vector<double> weights;
      for (const unsigned int m :
           problem.region_to_material(mesh.physical_mesh()))
        weights.push_back(-problem.materials[m].density * problem.gravity[1]);
      largest_weight = *std::max_element(weights.begin(), weights.end());
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
        for (const ElementEdge &edge : mesh.edges(e))
          if (edge.curve_set != invalid_index &&
              (edge.neighbor == invalid_index ||
               weights[mesh.region(edge.neighbor)] != weights[mesh.region(e)]))
            add(edge, weights[mesh.region(e)]);
      sort_into_buckets();
    }


    /// An arc is divided where it is vertical.
    void
    Overburden::add(const ElementEdge &edge, const double unit_weight)
    {
      Point<2> start = edge.start;
      if (edge.is_arc())
      {
        const double sign   = edge.radius > 0. ? 1. : -1.;
        const double radius = std::abs(edge.radius);
        const double full   = 2. * dealii::numbers::PI;
        const double first  = angle_about(edge.center, edge.start);
        const double sweep  = std::abs(swept_angle(edge));
        std::vector<std::pair<double, double>> turns;
        for (const double side : {1., -1.})
        {
          double at = sign * ((side > 0. ? 0. : dealii::numbers::PI) - first);
          at -= full * std::floor(at / full);
          if (at > 0. && at < sweep)
            turns.emplace_back(at, side);
        }
        std::sort(turns.begin(), turns.end());
        for (const auto &[at, side] : turns)
        {
          const Point<2> turn(edge.center[0] + side * radius, edge.center[1]);
          add_piece(start, turn, edge, unit_weight);
          start = turn;
        }
      }
      add_piece(start, edge.end, edge, unit_weight);
    }


    /// The region is on the left: below the edge if it runs to the left.
    void
    Overburden::add_piece(const Point<2>    &start,
                          const Point<2>    &end,
                          const ElementEdge &edge,
                          const double       unit_weight)
    {
      const bool is_above = end[0] < start[0];
      least               = std::min({least, start[0], end[0]});
      largest             = std::max({largest, start[0], end[0]});
      if (start[0] != end[0])
        pieces.push_back({is_above ? end : start,
                          is_above ? start : end,
                          edge.center,
                          std::abs(edge.radius),
                          is_above ? unit_weight : -unit_weight});
    }


    void
    Overburden::sort_into_buckets()
    {
      buckets.resize(1 + pieces.size() / 4);
      for (unsigned int p = 0; p < pieces.size(); ++p)
        for (std::size_t b = bucket(pieces[p].left[0]);
             b <= bucket(pieces[p].right[0]);
             ++b)
          buckets[b].push_back(p);
    }


    /// A vertical through the common end of two pieces crosses that on its right.
    std::vector<std::pair<double, double>>
    Overburden::crossings(const double x) const
    {
      std::vector<std::pair<double, double>> result;
      for (const unsigned int p : buckets[bucket(x)])
        if (pieces[p].left[0] <= x && x < pieces[p].right[0])
          result.emplace_back(pieces[p].elevation(x), pieces[p].change);
      std::sort(result.begin(), result.end(), [](const auto &a, const auto &b) {
        return a.first > b.first;
      });
      return result;
    }


    double
    Overburden::vertical_stress(const Point<2> &x) const
    {
      // Fractions of the width by which verticals along the ends are moved into the solid, since
      // vertical edges there are so only within rounding, and of the unit weight below which there is
      // a void.
      constexpr double inwards = 1e-12, empty = 1e-9;

      const double margin = inwards * (largest - least);
      const auto   on_vertical =
        crossings(std::min(std::max(x[0], least + margin), largest - margin));
      const double top =
        ground ? ground(x[0])
               : (on_vertical.empty() ? x[1] : on_vertical.front().first);
      double weight = 0., filled = weight_above, from = top, sum = 0.;
      for (const auto &[y, change] : on_vertical)
      {
        if (y <= x[1])
          break;
        const double to = std::min(y, top);
        sum += filled * (from - to);
        from = to;
        weight += change;
        if (weight > empty * largest_weight)
          filled = weight;
      }
      return -(sum + filled * std::max(0., from - x[1]));
    }


    /// The in-situ stress of one material.
    class StressOfWeight : public dealii::Function<2>
    {
    public:
      StressOfWeight(std::shared_ptr<const Overburden> overburden,
                     const std::vector<double>        &ratios)
        : dealii::Function<2>(ratios.size())
        , overburden(std::move(overburden))
        , ratios(ratios)
      {
      }

      double
      value(const Point<2> &x, const unsigned int component) const override
      {
        return ratios[component] == 0.
                 ? 0.
                 : ratios[component] * overburden->vertical_stress(x);
      }

    private:
      std::shared_ptr<const Overburden> overburden;
      /// Stress over the vertical stress for xx, yy, xy and zz [-].
      std::vector<double> ratios;
    };
  } // namespace


  double
  InSituStress::ratio(const Material  &material,
                      const PlaneState plane_state) const
  {
    const double nu = material.poissons_ratio;
    return K0                                        ? *K0
           : plane_state == PlaneState::plane_strain ? nu / (1. - nu)
                                                     : nu;
  }


  void
  InSituStress::check(const PlaneState plane_state) const
  {
    const std::string where = "the in-situ stress";
    for (const std::optional<double> &K : {K0, K0_out_of_plane})
      AssertThrow(!K || (std::isfinite(*K) && *K >= 0.),
                  InputError("a ratio K0 is " + std::to_string(*K),
                             where,
                             "give a number that is not negative"));
    AssertThrow(!K0_out_of_plane || plane_state == PlaneState::plane_strain,
                InputError("there is no stress across the plane in plane "
                           "stress",
                           where,
                           "remove 'K0 out of plane', or choose plane strain"));
    AssertThrow(std::isfinite(unit_weight_above) && unit_weight_above >= 0.,
                InputError("the unit weight above the solid is " +
                             std::to_string(unit_weight_above) + " N/m^3",
                           where,
                           "give a number that is not negative"));
    AssertThrow(unit_weight_above == 0. || !ground_line.empty(),
                InputError("there is a unit weight above the solid, but no "
                           "ground line up to which it reaches",
                           where,
                           "give the ground line"));
    if (!ground_line.empty())
      line_by_points(ground_line, "the ground line");
  }


  void
  set_in_situ_stress(const InSituStress &stress,
                     const ManifoldMesh &mesh,
                     ElasticityProblem  &problem)
  {
    stress.check(problem.plane_state);
    AssertThrow(
      problem.gravity[0] == 0. && problem.gravity[1] < 0.,
      InputError("gravity does not point downwards, so that no weight "
                 "makes an in-situ stress",
                 to_string(Point<2>(problem.gravity)) + " m/s^2",
                 "give it a negative y component alone"));
    const auto overburden =
      std::make_shared<const Overburden>(stress, mesh, problem);
    for (Material &material : problem.materials)
    {
      AssertThrow(!material.has_initial_stress(),
                  InputError("it has an initial stress beside the in-situ "
                             "stress of its weight",
                             "material \"" + material.name + "\"",
                             "remove one of them"));
      const double        K0     = stress.ratio(material, problem.plane_state);
      std::vector<double> ratios = {K0, 1., 0.};
      if (problem.plane_state == PlaneState::plane_strain)
        ratios.push_back(stress.K0_out_of_plane.value_or(K0));
      material.varying_initial_stress =
        std::make_shared<const StressOfWeight>(overburden, ratios);
    }
  }
} // namespace NMM
