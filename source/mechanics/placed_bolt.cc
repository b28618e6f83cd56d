#include <nmm/base/archive.h>
#include <nmm/base/exceptions.h>

#include <algorithm>
#include <base/cross.h>
#include <cmath>
#include <mechanics/placed_bolt.h>

namespace NMM
{
  namespace internal
  {
    using dealii::Point;
    using dealii::Tensor;

    namespace
    {
      BarSection
      section_of(const Bolt &bolt)
      {
        BarSection section;
        section.stiffness      = bolt.youngs_modulus * bolt.area / bolt.spacing;
        section.bond_stiffness = bolt.bond_stiffness / bolt.spacing;
        section.bond_strength  = bolt.bond_strength / bolt.spacing;
        section.yield_force    = bolt.yield_force / bolt.spacing;
        section.rupture_strain = bolt.rupture_strain;
        // ten diameters, as in a tensile test
        section.gauge_length = 20. * std::sqrt(bolt.area / dealii::numbers::PI);
        return section;
      }


      /// The bar turns with vectors of the current configuration.
      double
      norm_of(const Tensor<1, 2> &a, const Tensor<1, 2> &change)
      {
        return (a + change).norm();
      }


      Tensor<1, 2>
      unit(const Tensor<1, 2> &a)
      {
        return a / a.norm();
      }
    } // namespace


    PlacedBolt::PlacedBolt(const CoverSystem &covers,
                           const ModelLayout &layout,
                           const Bolt        &bolt,
                           const Kinematics   kinematics)
      : given(bolt)
      , kinematics(kinematics)
    {
      double length = 0.;
      for (unsigned int i = 0; i + 1 < bolt.path.size(); ++i)
        length += bolt.path[i].distance(bolt.path[i + 1]);
      std::vector<double> further;
      const double        free = length - bolt.grouted_length;
      if (free > 0.)
        further.push_back(free);
      const std::vector<BoltStretch> stretches =
        cut_bolt_path(covers.manifold_mesh(),
                      bolt.path,
                      further,
                      "the bolt '" + bolt.name + "'");
      const BarSection section    = section_of(bolt);
      const bool       is_grouted = bolt.type == Bolt::Type::grouted;
      std::vector<BoltBar::Element> elements;
      std::vector<unsigned int>     n_elements;
      for (unsigned int i = 0; i < stretches.size(); ++i)
      {
        const auto is_bonded = [&](const unsigned int k) {
          return is_grouted && stretches[k].is_in_rock &&
                 0.5 * (stretches[k].begin + stretches[k].end) > free;
        };
        const auto joins = [&](const unsigned int before) {
          return stretches[before + 1].continues && is_bonded(before) &&
                 is_bonded(before + 1);
        };
        const std::vector<BoltBar::Element> of_stretch =
          make_elements(stretches[i],
                        section,
                        is_bonded(i),
                        i == 0 ? bolt.faceplate : !joins(i - 1),
                        i + 1 < stretches.size() && !joins(i));
        n_elements.push_back(of_stretch.size());
        elements.insert(elements.end(), of_stretch.begin(), of_stretch.end());
      }
      bar.emplace(section,
                  elements,
                  /* head_is_tied = */ !is_grouted || bolt.faceplate,
                  /* toe_is_tied = */ !is_grouted);
      AssertThrow(bolt.pretension / bolt.spacing <= bar->largest_pretension(),
                  InputError("the pretension is more than bond and bar bear",
                             "bolt '" + bolt.name + "'",
                             "give a lower one, or a stronger bolt"));
      const double bending = bolt.youngs_modulus * bolt.area * bolt.area /
                             (4. * dealii::numbers::PI);
      beta            = bolt.bedding_stiffness > 0.
                          ? std::pow(bolt.bedding_stiffness / (4. * bending), 0.25)
                          : std::cbrt(bolt.dowel_stiffness / bending);
      dowel_stiffness = bending * beta * beta * beta / bolt.spacing;

      add_stations(covers, layout, stretches, n_elements);
      make_crossings(stretches, n_elements);
      number_unknowns();
      set_presence({});
      forget();
    }


    void
    PlacedBolt::add_stations(const CoverSystem               &covers,
                             const ModelLayout               &layout,
                             const std::vector<BoltStretch>  &stretches,
                             const std::vector<unsigned int> &n_elements)
    {
      const bool is_head_tied =
        given.type == Bolt::Type::end_anchored || given.faceplate;
      unsigned int site = 0, e = 0;
      const auto   add = [&](const Point<2> &x, const unsigned int of_site) {
        vectors.push_back(
          material_point(covers,
                         *layout.constraints,
                         x,
                         "a point of the bolt '" + given.name + "'"));
        vectors.back().constant -= x;
        stations.push_back({x, of_site});
      };
      for (unsigned int i = 0; i < stretches.size(); ++i)
      {
        const BoltStretch &stretch = stretches[i];
        const double       length  = stretch.end - stretch.begin;
        if (!stretch.is_in_rock)
        {
          ends.insert(ends.end(),
                      n_elements[i],
                      {{invalid_index, invalid_index}});
          e += n_elements[i];
          continue;
        }
        const auto place = [&](const double s) {
          return stretch.first +
                 (s - stretch.begin) / length * (stretch.last - stretch.first);
        };
        if (!stretch.continues)
          add(stretch.first, i == 0 && is_head_tied ? site++ : invalid_index);
        for (unsigned int k = 0; k < n_elements[i]; ++k, ++e)
        {
          const BoltBar::Element &element = bar->elements()[e];
          const unsigned int      begin   = stations.size() - 1;
          for (unsigned int q = 0; element.is_bonded && q < 3; ++q, ++site)
            add(place(bar->sites()[site].s), site);
          const bool is_toe = e + 1 == bar->elements().size() &&
                              given.type == Bolt::Type::end_anchored;
          add(place(element.end), is_toe ? site++ : invalid_index);
          ends.push_back(
            {{begin, static_cast<unsigned int>(stations.size()) - 1}});
        }
      }
      AssertDimension(site, bar->sites().size());
    }


    void
    PlacedBolt::make_crossings(const std::vector<BoltStretch>  &stretches,
                               const std::vector<unsigned int> &n_elements)
    {
      unsigned int e = 0;
      for (unsigned int i = 0; i < stretches.size(); e += n_elements[i], ++i)
      {
        if (!stretches[i].crosses)
          continue;
        Crossing crossing{stretches[i].joint,
                          ends[e - 1][1],
                          ends[e][0],
                          ends[e - 1][0],
                          ends[e][1],
                          {}};
        crossing.axis = unit(
          unit(stations[crossing.before].x - stations[crossing.base_before].x) +
          unit(stations[crossing.base_after].x - stations[crossing.after].x));
        crossings.push_back(crossing);
      }
    }


    void
    PlacedBolt::number_unknowns()
    {
      for (const MaterialVector &vector : vectors)
        all_unknowns.insert(all_unknowns.end(),
                            vector.unknowns.begin(),
                            vector.unknowns.end());
      std::sort(all_unknowns.begin(), all_unknowns.end());
      all_unknowns.erase(std::unique(all_unknowns.begin(), all_unknowns.end()),
                         all_unknowns.end());
      for (const MaterialVector &vector : vectors)
      {
        places.emplace_back();
        for (const auto unknown : vector.unknowns)
          places.back().push_back(std::lower_bound(all_unknowns.begin(),
                                                   all_unknowns.end(),
                                                   unknown) -
                                  all_unknowns.begin());
      }
    }


    void
    PlacedBolt::set_presence(const std::vector<bool> &absent_blocks)
    {
      is_absent.assign(stations.size(), false);
      is_site_absent.assign(bar->sites().size(), false);
      for (unsigned int i = 0; i < stations.size(); ++i)
      {
        is_absent[i] =
          !absent_blocks.empty() && absent_blocks[vectors[i].blocks[0]];
        if (stations[i].site != invalid_index)
          is_site_absent[stations[i].site] = is_absent[i];
      }
      link();
    }


    void
    PlacedBolt::link()
    {
      links.clear();
      unsigned int last = invalid_index;
      for (unsigned int i = 0; i < stations.size(); ++i)
      {
        if (is_absent[i])
          continue;
        if (last != invalid_index)
        {
          unsigned int between = invalid_index;
          for (unsigned int c = 0; c < crossings.size(); ++c)
            if (crossings[c].before == last && crossings[c].after == i)
              between = c;
          links.push_back({last, i, between, stations[i].x - stations[last].x});
        }
        last = i;
      }
    }


    PlacedBolt::Displacements
    PlacedBolt::displacements(const ForceTerm::Vector &u) const
    {
      return evaluate(vectors, u);
    }


    std::pair<Tensor<1, 2>, Tensor<1, 2>>
    PlacedBolt::vectors_at(const Crossing      &crossing,
                           const Displacements &u) const
    {
      const auto between = [&](const unsigned int from, const unsigned int to) {
        return stations[to].x - stations[from].x + (u[to] - u[from]);
      };
      const Tensor<1, 2> d = between(crossing.before, crossing.after);
      if (kinematics == Kinematics::small)
        return {d, crossing.axis};
      const auto unit_of = [&](const unsigned int from, const unsigned int to) {
        return between(from, to) / (stations[to].x - stations[from].x).norm();
      };
      const Tensor<1, 2> straight =
        unit(stations[crossing.before].x - stations[crossing.base_before].x) +
        unit(stations[crossing.base_after].x - stations[crossing.after].x);
      return {d,
              (unit_of(crossing.base_before, crossing.before) +
               unit_of(crossing.after, crossing.base_after)) /
                straight.norm()};
    }


    PlacedBolt::Measures
    PlacedBolt::measure(const Displacements &u) const
    {
      Measures result;
      result.r.assign(stations.size(), 0.);
      for (const Crossing &crossing : crossings)
      {
        const auto at_rest       = Displacements(stations.size());
        const auto [d_0, axis_0] = vectors_at(crossing, at_rest);
        const auto [d, axis]     = vectors_at(crossing, u);
        result.along.push_back(axis * d - axis_0 * d_0);
        result.across.push_back(cross(axis, d) - cross(axis_0, d_0));
      }
      for (const Link &link : links)
      {
        const Tensor<1, 2> change = u[link.b] - u[link.a];
        double             elongation;
        if (link.crossing != invalid_index)
          elongation = result.along[link.crossing];
        else if (kinematics == Kinematics::small)
          elongation = unit(link.chord) * change;
        else
          // without the difference of two lengths
          elongation = (2. * link.chord + change) * change /
                       (norm_of(link.chord, change) + link.chord.norm());
        result.r[link.b] = result.r[link.a] + elongation;
      }
      return result;
    }


    std::vector<double>
    PlacedBolt::r_of_sites(const Measures &measures) const
    {
      std::vector<double> r(bar->sites().size(), 0.);
      const auto first = std::find(is_absent.begin(), is_absent.end(), false) -
                         is_absent.begin();
      for (unsigned int i = 0; i < stations.size(); ++i)
        if (stations[i].site != invalid_index && !is_absent[i])
          r[stations[i].site] =
            measures.r[i] - (reference.r[i] - reference.r[first]);
      return r;
    }


    BoltBar::Response
    PlacedBolt::respond(const Displacements &u) const
    {
      return bar->respond(state, r_of_sites(measure(u)), is_site_absent);
    }


    void
    PlacedBolt::begin(const Displacements &u)
    {
      reference    = measure(u);
      is_beginning = true;
    }


    PlacedBolt::Rows
    PlacedBolt::rows_of(
      const std::vector<std::pair<unsigned int, double>> &terms) const
    {
      Rows rows;
      for (auto &row : rows)
        row.assign(all_unknowns.size(), 0.);
      for (const auto &[station, factor] : terms)
        for (unsigned int i = 0; i < places[station].size(); ++i)
          for (unsigned int c = 0; c < 2; ++c)
            rows[c][places[station][i]] +=
              factor * vectors[station].weights[i][c];
      return rows;
    }


    std::pair<PlacedBolt::Rows, PlacedBolt::Rows>
    PlacedBolt::rows_at(const Crossing &crossing) const
    {
      const Rows d = rows_of({{crossing.after, 1.}, {crossing.before, -1.}});
      if (kinematics == Kinematics::small)
        return {d, rows_of({})};
      const Tensor<1, 2> before = stations[crossing.before].x -
                                  stations[crossing.base_before].x,
                         after = stations[crossing.base_after].x -
                                 stations[crossing.after].x;
      const double norm = (unit(before) + unit(after)).norm();
      const double f    = 1. / (norm * before.norm()),
                   g    = 1. / (norm * after.norm());
      return {d,
              rows_of({{crossing.before, f},
                       {crossing.base_before, -f},
                       {crossing.base_after, g},
                       {crossing.after, -g}})};
    }


    namespace
    {
      PlacedBolt::Displacements
      mean_of(const PlacedBolt::Displacements &a,
              const PlacedBolt::Displacements *b)
      {
        PlacedBolt::Displacements result = a;
        for (unsigned int i = 0; b != nullptr && i < a.size(); ++i)
          result[i] = 0.5 * (a[i] + (*b)[i]);
        return result;
      }


      void
      add_outer(const double               factor,
                const std::vector<double> &left,
                const std::vector<double> &right,
                PlacedBolt::Matrix        &sum)
      {
        for (unsigned int a = 0; a < left.size(); ++a)
          if (const double of_row = factor * left[a]; of_row != 0.)
            for (unsigned int b = 0; b < right.size(); ++b)
              sum(a, b) += of_row * right[b];
      }


      /// The derivative of the product x . y, or with @p turned of x times y.
      std::vector<double>
      derivative_of_product(const std::array<std::vector<double>, 2> &rows_x,
                            const Tensor<1, 2>                       &x,
                            const std::array<std::vector<double>, 2> &rows_y,
                            const Tensor<1, 2>                       &y,
                            const bool                                turned)
      {
        std::vector<double> result(rows_x[0].size());
        for (unsigned int i = 0; i < result.size(); ++i)
        {
          const Tensor<1, 2> dx({rows_x[0][i], rows_x[1][i]}),
            dy({rows_y[0][i], rows_y[1][i]});
          result[i] = turned ? cross(dx, y) + cross(x, dy) : dx * y + x * dy;
        }
        return result;
      }


      /// The second derivative of such a product, times a factor.
      void
      add_second_derivative(const double                              factor,
                            const std::array<std::vector<double>, 2> &rows_x,
                            const std::array<std::vector<double>, 2> &rows_y,
                            const bool                                turned,
                            PlacedBolt::Matrix                       &sum)
      {
        for (unsigned int c = 0; c < 2; ++c)
        {
          const unsigned int other = turned ? 1 - c : c;
          const double       sign  = turned && c == 1 ? -factor : factor;
          add_outer(sign, rows_x[c], rows_y[other], sum);
          add_outer(sign, rows_y[other], rows_x[c], sum);
        }
      }
    } // namespace


    std::vector<double>
    PlacedBolt::row_of(const Link          &link,
                       const Displacements &end,
                       const Displacements *begin) const
    {
      if (link.crossing != invalid_index)
      {
        const Crossing &crossing   = crossings[link.crossing];
        const auto [d, axis]       = vectors_at(crossing, mean_of(end, begin));
        const auto [of_d, of_axis] = rows_at(crossing);
        return derivative_of_product(of_axis, axis, of_d, d, false);
      }
      Tensor<1, 2> direction = unit(link.chord);
      if (kinematics == Kinematics::finite)
      {
        const Tensor<1, 2> d_1 = link.chord + (end[link.b] - end[link.a]),
                           d_0 = begin == nullptr
                                   ? d_1
                                   : link.chord +
                                       ((*begin)[link.b] - (*begin)[link.a]);
        direction              = (d_0 + d_1) / (d_0.norm() + d_1.norm());
      }
      const Rows          rows = rows_of({{link.b, 1.}, {link.a, -1.}});
      std::vector<double> result(all_unknowns.size());
      for (unsigned int i = 0; i < result.size(); ++i)
        result[i] = direction[0] * rows[0][i] + direction[1] * rows[1][i];
      return result;
    }


    PlacedBolt::Matrix
    PlacedBolt::rows_of_sites(const Displacements &end,
                              const Displacements *begin) const
    {
      const unsigned int  n = all_unknowns.size();
      Matrix              result(bar->sites().size(), n);
      std::vector<double> sum(n, 0.);
      const auto          store = [&](const unsigned int station) {
        if (const unsigned int site = stations[station].site;
            site != invalid_index)
          std::copy(sum.begin(), sum.end(), &result(site, 0));
      };
      for (const Link &link : links)
      {
        const std::vector<double> row = row_of(link, end, begin);
        for (unsigned int i = 0; i < n; ++i)
          sum[i] += row[i];
        store(link.b);
      }
      return result;
    }


    /// The force of a link is the sum of those of the sites behind it.
    void
    PlacedBolt::add_geometric(const std::vector<double> &forces,
                              const Displacements       &end,
                              const Displacements       *begin,
                              Matrix                    &tangent) const
    {
      double force = 0.;
      for (auto link = links.rbegin(); link != links.rend(); ++link)
      {
        if (const unsigned int site = stations[link->b].site;
            site != invalid_index)
          force += forces[site];
        if (link->crossing != invalid_index)
        {
          const auto [of_d, of_axis] = rows_at(crossings[link->crossing]);
          add_second_derivative(force, of_axis, of_d, false, tangent);
          continue;
        }
        const Tensor<1, 2> d_1 = link->chord + (end[link->b] - end[link->a]),
                           d_0 = begin == nullptr
                                   ? d_1
                                   : link->chord +
                                       ((*begin)[link->b] - (*begin)[link->a]);
        const double       lengths = d_0.norm() + d_1.norm();
        const Tensor<1, 2> left    = (d_0 + d_1) / lengths,
                           right   = d_1 / d_1.norm();
        const Rows rows            = rows_of({{link->b, 1.}, {link->a, -1.}});
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int k = 0; k < 2; ++k)
            add_outer(2. * force / lengths *
                        ((c == k ? 1. : 0.) - left[c] * right[k]),
                      rows[c],
                      rows[k],
                      tangent);
      }
    }


    void
    PlacedBolt::add_dowels(const Displacements &end,
                           const Displacements *begin,
                           Forces              &sum) const
    {
      if (dowel_stiffness == 0. || crossings.empty())
        return;
      const Measures      now  = measure(end);
      std::vector<double> slip = now.across;
      if (begin != nullptr)
      {
        const Measures before = measure(*begin);
        for (unsigned int c = 0; c < slip.size(); ++c)
          slip[c] = 0.5 * (slip[c] + before.across[c]);
      }
      for (unsigned int c = 0; c < crossings.size(); ++c)
      {
        if (is_cut(crossings[c]))
          continue;
        const double zero          = reference.across[c];
        const auto [of_d, of_axis] = rows_at(crossings[c]);
        const auto [d, axis] = vectors_at(crossings[c], mean_of(end, begin));
        const auto [d_1, axis_1] = vectors_at(crossings[c], end);
        const auto row = derivative_of_product(of_axis, axis, of_d, d, true);
        const auto row_1 =
          derivative_of_product(of_axis, axis_1, of_d, d_1, true);
        const double force = dowel_stiffness * (slip[c] - zero);
        for (unsigned int i = 0; i < row.size(); ++i)
          sum.forces[i] += force * row[i];
        sum.energy += 0.5 * dowel_stiffness *
                      dealii::Utilities::fixed_power<2>(now.across[c] - zero);
        if (sum.tangent.m() == 0)
          continue;
        add_outer(dowel_stiffness, row, row_1, sum.tangent);
        if (kinematics == Kinematics::finite)
          add_second_derivative(force, of_axis, of_d, true, sum.tangent);
      }
    }


    PlacedBolt::Forces
    PlacedBolt::assemble(const Displacements &end,
                         const Displacements *begin,
                         const bool           with_tangent) const
    {
      const BoltBar::Response response = respond(end);
      std::vector<double>     forces   = response.forces;
      Forces                  result;
      result.is_found = response.has_converged;
      if (begin != nullptr)
      {
        const BoltBar::Response before = respond(*begin);
        result.is_found = result.is_found && before.has_converged;
        for (unsigned int i = 0; i < forces.size(); ++i)
          forces[i] = 0.5 * (forces[i] + before.forces[i]);
      }
      const Matrix       left = rows_of_sites(end, begin);
      const unsigned int n    = all_unknowns.size();
      result.forces.reinit(n);
      for (unsigned int s = 0; s < forces.size(); ++s)
        for (unsigned int i = 0; forces[s] != 0. && i < n; ++i)
          result.forces[i] += forces[s] * left(s, i);
      result.energy = response.energy;
      if (with_tangent)
      {
        const bool is_finite = kinematics == Kinematics::finite;
        result.tangent       = bar->condense(response,
                                       left,
                                       begin != nullptr && is_finite
                                               ? rows_of_sites(end, nullptr)
                                               : left);
        if (is_finite)
          add_geometric(forces, end, begin, result.tangent);
      }
      add_dowels(end, begin, result);
      return result;
    }


    StepWork
    PlacedBolt::commit(const Displacements &end, const Displacements *begin)
    {
      StepWork work;
      if (is_beginning)
        work.supports =
          bar
            ->respond(state,
                      std::vector<double>(bar->sites().size(), 0.),
                      is_site_absent)
            .energy;
      const BoltBar::Response now = respond(end);
      if (begin != nullptr)
      {
        const BoltBar::Response before = respond(*begin);
        work.dissipated                = bar->dissipated(state, &before, now);
      }
      else
        work.dissipated = bar->dissipated(state, nullptr, now);
      state        = now.next;
      is_installed = true;
      is_beginning = false;
      if (const unsigned int e = bar->find_rupture(now);
          e < bar->elements().size())
      {
        state.is_broken[e] = 1;
        work.dissipated += now.energy - respond(end).energy;
      }
      return work;
    }


    void
    PlacedBolt::forget()
    {
      is_installed = is_beginning = false;
      state     = bar->initial_state(given.pretension / given.spacing);
      reference = measure(Displacements(stations.size()));
    }


    bool
    PlacedBolt::is_consistent() const
    {
      return state.slip.size() == bar->sites().size() &&
             state.strain.size() == 2 * bar->elements().size() &&
             state.is_broken.size() == bar->elements().size() &&
             reference.r.size() == stations.size() &&
             reference.along.size() == crossings.size() &&
             reference.across.size() == crossings.size() &&
             are_finite(state.slip) && are_finite(state.strain) &&
             std::isfinite(state.head_offset) && are_finite(reference.r) &&
             are_finite(reference.along) && are_finite(reference.across);
    }


    BoltReport
    PlacedBolt::report(const Displacements &u) const
    {
      BoltReport result;
      result.is_installed              = is_installed;
      const Measures          measures = measure(u);
      const auto             &elements = bar->elements();
      const BoltBar::Response response =
        is_installed ? bar->respond(state, r_of_sites(measures), is_site_absent)
                     : BoltBar::Response();
      const std::vector<double> axial =
        is_installed ? bar->axial_at_ends(response)
                     : std::vector<double>(elements.size() + 1, 0.);
      const auto first = std::find(is_absent.begin(), is_absent.end(), false) -
                         is_absent.begin();
      unsigned int site = bar->sites()[0].weight == 0. ? 1 : 0;
      for (unsigned int e = 0; e < elements.size(); ++e)
      {
        for (const unsigned int side : {0, 1})
        {
          const unsigned int station = ends[e][side];
          const bool         continues =
            side == 0 && e > 0 && ends[e - 1][1] == station;
          if (continues || station == invalid_index)
            continue;
          BoltReport::Place place;
          place.s     = side == 0 ? elements[e].begin : elements[e].end;
          place.x     = stations[station].x;
          place.u     = u[station];
          place.force = given.spacing * axial[e + side];
          if (is_installed && elements[e].is_bonded && !is_absent[station])
          {
            place.slip = response.v[BoltBar::node(e + side, 0)] -
                         (measures.r[station] -
                          (reference.r[station] - reference.r[first]));
            place.bond = bar->has_slipped(state, site + 2 * side)
                           ? BoltReport::Bond::yielded
                           : BoltReport::Bond::elastic;
          }
          if (std::abs(place.force) > std::abs(result.largest_force))
            result.largest_force = place.force;
          result.places.push_back(place);
        }
        if (elements[e].is_bonded)
          site += 3;
        for (const unsigned int q : {0, 1})
          if (state.strain[BoltBar::point(e, q)] != 0. &&
              state.is_broken[e] == 0)
            result.yielded_length +=
              0.5 * (elements[e].end - elements[e].begin);
        result.n_breaks += state.is_broken[e] != 0;
      }
      for (unsigned int i = 0; i < bar->sites().size(); ++i)
        if (bar->has_slipped(state, i))
          result.slipped_length += bar->sites()[i].weight;
      for (unsigned int c = 0; c < crossings.size(); ++c)
      {
        BoltReport::Crossing crossing;
        unsigned int         e = 0;
        while (ends[e][0] != crossings[c].after)
          ++e;
        crossing.joint = crossings[c].joint;
        crossing.s     = elements[e].begin;
        crossing.x     = stations[crossings[c].after].x;
        crossing.force = given.spacing * axial[e];
        if (is_installed && !is_cut(crossings[c]))
        {
          crossing.opening = measures.along[c] - reference.along[c];
          crossing.slip    = measures.across[c] - reference.across[c];
          crossing.dowel_force =
            given.spacing * dowel_stiffness * crossing.slip;
          if (beta > 0.)
            crossing.moment = std::abs(crossing.dowel_force) *
                              std::exp(-dealii::numbers::PI_4) *
                              std::sqrt(0.5) / beta;
        }
        result.crossings.push_back(crossing);
      }
      return result;
    }
  } // namespace internal
} // namespace NMM
