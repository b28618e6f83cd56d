#ifndef nmm_geometry_joint_network_h
#define nmm_geometry_joint_network_h

#include <nmm/geometry/geometry.h>

#include <string>
#include <vector>

namespace NMM
{
  /**
   * A set of joints: parallel lines at equal distances, on each of which joint traces alternate
   * with rock bridges. Distances, dips and lengths can have random scatter. With the direction
   * @f$ d = (\cos\alpha, \sin\alpha) @f$ and its normal @f$ n @f$, line k is
   * @f[ n\cdot x = o + (k + \tfrac{s_s}{2} r)\,s, @f]
   * and trace j on it covers the fraction p of the period from @f$ (j+\varphi)\,L/p @f$ to
   * @f$ (j+1+\varphi)\,L/p @f$ along d, L being the mean length of a trace, p the
   * persistence, s the spacing, o the offset, and r from [-1, 1] and
   * @f$ \varphi @f$ from [0, 1) random numbers of the line.
   *
   * Intensities: without scatter of dips the length of traces per area is
   * P21 = p / s [1/m], and their number per area P20 = p / (s L) [1/m^2].
   *
   * The random numbers of a line or trace depend only on the seed and on k and j, so that a
   * larger solid has more of the same network. They are taken from bits of
   * std::mt19937_64, and coordinates are rounded to about 1e-12 of the solid's
   * size, so that a seed gives the same network on every machine.
   */
  struct JointSet
  {
    /// Name of all joints of the set, by which contact laws refer to them.
    std::string name;
    /// Angle alpha from the x-axis to the joints, counter-clockwise [degrees].
    double dip = 0.;
    /// Largest angle by which a line is turned, about its point that is nearest to the
    /// middle of the solid [degrees].
    double dip_scatter = 0.;
    /// Mean distance s between lines [m].
    double spacing = 0.;
    /// Largest relative deviation s_s of a distance from the spacing [-], from 0 to 1.
    double spacing_scatter = 0.;
    /// Persistence p, the fraction of a line that is jointed [-], above 0 and up to 1; 1 stands for
    /// joints without bridges.
    double persistence = 1.;
    /// Mean length L of a trace [m]; used only with a persistence below 1.
    double trace_length = 0.;
    /// Largest relative deviation of a trace's length from L [-], at most 1/p - 1.
    double trace_length_scatter = 0.;
    /// Distance o of line 0 from the origin, along n = (-sin alpha, cos alpha) [m].
    double offset = 0.;
    /// Seed of the random numbers.
    unsigned int seed = 1;
    /// Connection of the faces of all joints, see Curve::state.
    JointState state = JointState::open;
    /// Domain or region to which the joints are confined, see Curve::within.
    std::string within;
    /// Whether ends that bound no block are removed, see Curve::drops_ends.
    bool drops_ends = false;

    /// Check all values. @throws InputError naming the set, the value and its limits.
    void
    check() const;
  };


  /**
   * Expected number of crossings between joints of different sets, before any joint is made:
   * @f[ \sum_{a<b} A_{ab}\,\frac{p_a}{s_a}\,\frac{p_b}{s_b}\,
       |\sin(\theta_a-\theta_b)| @f]
   * with persistence p [-], spacing s [m] and dip @f$\theta@f$ of each set. p / s is
   * the length of traces per area, and the formula holds for independently placed lines.
   * @f$A_{ab}@f$ is the smaller one of the areas to which the sets are confined [m^2], and 0
   * if these are two different regions. Holes and the scatter of dips are neglected.
   * @throws InputError for a set with bad values or a geometry without boundary.
   */
  double
  estimate_crossings(const std::vector<JointSet> &sets,
                     const Geometry              &geometry);


  /// Expected length of the joints of all sets [m], the sum of A p / s of estimate_crossings(),
  /// before any joint is made.
  /// @throws InputError for a set with bad values or a geometry without boundary.
  double
  estimate_length(const std::vector<JointSet> &sets, const Geometry &geometry);


  /**
   * Make the joints of a set that may meet the solid of @p geometry: segments in its
   * bounding box (or that of the region to which they are confined), which PhysicalMesh
   * clips to the solid. @throws InputError for a set with bad values, a geometry
   * without boundary, or more than a million traces.
   */
  std::vector<Curve>
  make_joints(const JointSet &set, const Geometry &geometry);
} // namespace NMM

#endif
