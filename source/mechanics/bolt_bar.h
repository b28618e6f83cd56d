#ifndef nmm_source_mechanics_bolt_bar_h
#define nmm_source_mechanics_bolt_bar_h

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <limits>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Cross-section and bond of a bar. All forces are per unit thickness: those of one bolt over
    /// the spacing.
    struct BarSection
    {
      /// E A [N/m].
      double stiffness = 0.;
      /// Shear force per length and slip [Pa/m].
      double bond_stiffness = 0.;
      /// Largest shear force per length [Pa].
      double bond_strength = std::numeric_limits<double>::infinity();
      /// Axial force at which the bar yields [N/m].
      double yield_force = std::numeric_limits<double>::infinity();
      /// Mean strain at which it breaks [-], and the length over which the mean is taken [m].
      double rupture_strain = std::numeric_limits<double>::infinity();
      double gauge_length   = 0.;
    };


    /**
     * An elastic-plastic bar in a hole, for given displacements r of the rock along it. With the
     * displacement v(s) of the bar, s from its head,
     * @f[ \Psi(v, r) = \int \psi_a(v')\,ds + \int \psi_b(v - r)\,ds
           + \sum_\mathrm{ties} \tfrac12\kappa (v - r - o)^2 \rightarrow \min_v, @f]
     * where N = psi_a' is EA (v' - e_p) up to the yield force, and the bond stress tau = psi_b' is
     * k (v - r - w_p) up to the bond strength. e_p and w_p are the state of the step before
     * (backward Euler). A millionth of each stiffness is left after yielding, so that the minimum
     * is unique. Ties at head and toe have kappa = 1e6 EA / L. The offset o of the head is that
     * with which it was fastened under pretension.
     *
     * The bar has elements of second order, with two points of N and three of tau each. The energy
     * is convex and piecewise quadratic: Newton's method with a line search ends at its minimum.
     * The bar's own unknowns are condensed: forces f = dPsi/dr on the rock, and
     * @f[ \frac{df}{dr} = \Psi_{rr} - \Psi_{rv}\,\Psi_{vv}^{-1}\,\Psi_{vr}. @f]
     * Cost: O(elements) for the minimum, O(elements n^2) for the derivative by n unknowns.
     */
    class BoltBar
    {
    public:
      /// Stiffness that is left after yielding, over the elastic one.
      static constexpr double hardening = 1e-6;

      /// A piece of the bar [m].
      struct Element
      {
        double begin = 0., end = 0.;
        bool   is_bonded = false;
        /// Stiffness left after yielding, over the elastic one.
        double hardening = BoltBar::hardening;
      };

      /// A place where the bar is fastened to the rock: a point of the bond, or a tie.
      struct Site
      {
        double s = 0.;
        /// Length of bond that it stands for [m]; 0 for a tie.
        double                weight  = 0.;
        unsigned int          element = 0;
        std::array<double, 3> shape{};
      };

      /// What the bar remembers.
      struct State
      {
        /// Plastic slip of the sites [m], and plastic strain of the two points of each element [-].
        std::vector<double> slip, strain;
        /// Whether an element is broken.
        std::vector<char> is_broken;
        /// Offset of the tie at the head [m].
        double head_offset = 0.;

        template <class Archive>
        void
        serialize(Archive &archive, unsigned int)
        {
          archive &slip &strain &is_broken &head_offset;
        }
      };

      /// The bar in equilibrium.
      struct Response
      {
        /// Displacements of its nodes: begin, middle and end of each element [m].
        std::vector<double> v;
        /// Forces f of the sites and their derivatives by v - r; 0 for absent ones.
        std::vector<double> forces, stiffnesses;
        /// Axial force in the two points of each element, positive in tension [N/m].
        std::vector<double> axial;
        /// The state after the step.
        State next;
        /// Stored energy [J/m].
        double energy = 0.;
        /// Factors of Psi_vv: the diagonal, and both bands below it.
        std::array<std::vector<double>, 3> factors;
        /// Whether the equilibrium was found.
        bool has_converged = false;
      };

      BoltBar(const BarSection    &section,
              std::vector<Element> elements,
              bool                 head_is_tied,
              bool                 toe_is_tied);

      /// Number of the node @p local of an element: 0 at its begin, 1 in the middle, 2 at its end.
      static unsigned int
      node(const unsigned int element, const unsigned int local)
      {
        return element + element + local;
      }

      /// Number of the point @p q of an element in which the axial force is taken, 0 or 1.
      static unsigned int
      point(const unsigned int element, const unsigned int q)
      {
        return element + element + q;
      }

      /// The sites, from the head.
      const std::vector<Site> &
      sites() const
      {
        return all_sites;
      }

      const std::vector<Element> &
      elements() const
      {
        return all_elements;
      }

      /// The state of a bar whose head was drawn out of rock at rest by @p pretension [N/m] and
      /// then fastened. Without ties nothing is drawn.
      State
      initial_state(double pretension) const;

      /// The largest pretension that the bar bears [N/m].
      double
      largest_pretension() const;

      /// Equilibrium with the displacements @p r of the sites [m], of which some may be absent.
      Response
      respond(const State               &state,
              const std::vector<double> &r,
              const std::vector<bool>   &is_absent) const;

      /// left^T (df/dr) right, for matrices with a row for each site.
      dealii::FullMatrix<double>
      condense(const Response                   &response,
               const dealii::FullMatrix<double> &left,
               const dealii::FullMatrix<double> &right) const;

      /// Axial forces at the ends of all elements, from the equilibrium of the nodes [N/m].
      std::vector<double>
      axial_at_ends(const Response &response) const;

      /// Energy dissipated from @p before to the state after @p end [J/m]. With @p begin the mean
      /// forces work.
      double
      dissipated(const State    &before,
                 const Response *begin,
                 const Response &end) const;

      /// The element that breaks, since the mean strain over the gauge length exceeds that of
      /// rupture; the number of elements if none does.
      unsigned int
      find_rupture(const Response &response) const;

      /// Whether the bond of a site has slipped.
      bool
      has_slipped(const State &state, unsigned int site) const;

    private:
      struct Trial;

      unsigned int
      n_nodes() const
      {
        return node(all_elements.size(), 1);
      }

      void
      assemble(const State               &state,
               const std::vector<double> &r,
               const std::vector<bool>   &is_absent,
               double                     head_load,
               bool                       may_yield,
               Trial                     &trial) const;

      Trial
      minimize(const State               &state,
               const std::vector<double> &r,
               const std::vector<bool>   &is_absent,
               double                     head_load) const;

      BarSection           section;
      std::vector<Element> all_elements;
      std::vector<Site>    all_sites;
      bool                 head_is_tied, toe_is_tied;
      double               tie_stiffness;
    };
  } // namespace internal
} // namespace NMM

#endif
