#ifndef nmm_source_mechanics_placed_bolt_h
#define nmm_source_mechanics_placed_bolt_h

#include <nmm/mechanics/bolt.h>
#include <nmm/mechanics/force_term.h>

#include <array>
#include <mechanics/bolt_bar.h>
#include <mechanics/bolt_path.h>
#include <optional>
#include <utility>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * A bolt in the rock: stations, which are material points along it, and what their
     * displacements are for its bar, see BoltTerm. A line of stations runs from the head to the
     * toe; neighbours that are present are joined by links, whose elongations add up to r. A joint
     * that is crossed has a station on each of its sides.
     */
    class PlacedBolt
    {
    public:
      using Unknowns = ForceTerm::Unknowns;
      /// A displacement for each station [m].
      using Displacements = std::vector<dealii::Tensor<1, 2>>;
      using Matrix        = dealii::FullMatrix<double>;

      /// What displacements are for the bar: r at each station, and of each crossing the components
      /// of the vector between its sides along the bolt and to its left [m].
      struct Measures
      {
        std::vector<double> r, along, across;

        template <class Archive>
        void
        serialize(Archive &archive, unsigned int)
        {
          archive &r &along &across;
        }
      };

      /// A joint that is crossed, between two stations. The direction of the bolt there is that
      /// from each base to the station on its side.
      struct Crossing
      {
        std::string          joint;
        unsigned int         before, after, base_before, base_after;
        dealii::Tensor<1, 2> axis;
      };

      /// Forces on the bolt's unknowns, and their derivative.
      struct Forces
      {
        dealii::Vector<double> forces;
        Matrix                 tangent;
        /// Stored [J/m].
        double energy = 0.;
        /// Whether the bar is in equilibrium.
        bool is_found = false;
      };

      PlacedBolt(const CoverSystem &covers,
                 const ModelLayout &layout,
                 const Bolt        &bolt,
                 Kinematics         kinematics);

      const Bolt &
      bolt() const
      {
        return given;
      }

      /// Free unknowns of all stations, ascending.
      const Unknowns &
      unknowns() const
      {
        return all_unknowns;
      }

      /// Places of the stations in the reference configuration [m].
      std::vector<dealii::Point<2>>
      places_of_stations() const
      {
        std::vector<dealii::Point<2>> result;
        for (const Station &station : stations)
          result.push_back(station.x);
        return result;
      }

      void
      set_presence(const std::vector<bool> &absent_blocks);

      /// The displacements of all stations. Collective.
      Displacements
      displacements(const ForceTerm::Vector &u) const;

      /// Whether it acts, or will at the end of this step.
      bool
      is_active() const
      {
        return is_installed || is_beginning;
      }

      /// Install it in a step that begins with @p u.
      void
      begin(const Displacements &u);

      /// Give up the installation in a step that was not accepted.
      void
      withdraw()
      {
        is_beginning = false;
      }

      /// Forces at @p end, or with @p begin the conserving ones.
      Forces
      assemble(const Displacements &end,
               const Displacements *begin,
               bool                 with_tangent) const;

      StepWork
      commit(const Displacements &end, const Displacements *begin);

      void
      forget();

      BoltReport
      report(const Displacements &u) const;

      template <class Archive>
      void
      serialize(Archive &archive, unsigned int)
      {
        archive &is_installed &state &reference;
      }

      /// Whether what was restored fits.
      bool
      is_consistent() const;

    private:
      struct Station
      {
        dealii::Point<2> x;
        unsigned int     site;
      };

      /// Two neighbouring stations that are present, and the crossing between them or
      /// invalid_index.
      struct Link
      {
        unsigned int         a, b, crossing;
        dealii::Tensor<1, 2> chord;
      };

      void
      add_stations(const CoverSystem               &covers,
                   const ModelLayout               &layout,
                   const std::vector<BoltStretch>  &stretches,
                   const std::vector<unsigned int> &n_elements);

      void
      number_unknowns();

      /// Make the links between the stations that are present.
      void
      link();

      void
      make_crossings(const std::vector<BoltStretch>  &stretches,
                     const std::vector<unsigned int> &n_elements);

      Measures
      measure(const Displacements &u) const;

      /// r of each site since the installation.
      std::vector<double>
      r_of_sites(const Measures &measures) const;

      BoltBar::Response
      respond(const Displacements &u) const;

      /// The vector between both sides of a crossing, and the direction of the bolt there.
      std::pair<dealii::Tensor<1, 2>, dealii::Tensor<1, 2>>
      vectors_at(const Crossing &crossing, const Displacements &u) const;

      /// Derivatives by the unknowns: of a vector of stations with factors, by component.
      using Rows = std::array<std::vector<double>, 2>;

      Rows
      rows_of(
        const std::vector<std::pair<unsigned int, double>> &stations) const;

      std::pair<Rows, Rows>
      rows_at(const Crossing &crossing) const;

      /// The derivative of a link's elongation, for conserving forces with both displacements.
      std::vector<double>
      row_of(const Link          &link,
             const Displacements &end,
             const Displacements *begin) const;

      Matrix
      rows_of_sites(const Displacements &end, const Displacements *begin) const;

      void
      add_geometric(const std::vector<double> &forces,
                    const Displacements       &end,
                    const Displacements       *begin,
                    Matrix                    &tangent) const;

      void
      add_dowels(const Displacements &end,
                 const Displacements *begin,
                 Forces              &sum) const;

      bool
      is_cut(const Crossing &crossing) const
      {
        return is_absent[crossing.before] || is_absent[crossing.after];
      }

      Bolt       given;
      Kinematics kinematics;
      /// The dowel stiffness per unit thickness [Pa], and beta [1/m].
      double dowel_stiffness = 0., beta = 0.;

      std::optional<BoltBar> bar;
      std::vector<Station>   stations;
      /// The displacement of each station as a function of the unknowns.
      std::vector<MaterialVector> vectors;
      /// Stations at the begin and end of each element; invalid_index outside the rock.
      std::vector<std::array<unsigned int, 2>> ends;
      std::vector<Crossing>                    crossings;
      Unknowns                                 all_unknowns;
      /// For each station, the places of its unknowns in all_unknowns.
      std::vector<std::vector<unsigned int>> places;

      std::vector<bool> is_absent, is_site_absent;
      std::vector<Link> links;

      bool           is_installed = false, is_beginning = false;
      BoltBar::State state;
      Measures       reference;
    };
  } // namespace internal
} // namespace NMM

#endif
