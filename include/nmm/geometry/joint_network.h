#ifndef nmm_geometry_joint_network_h
#define nmm_geometry_joint_network_h

#include <nmm/geometry/geometry.h>

#include <string>
#include <vector>

namespace NMM
{
  /**
   * A set of joints: parallel lines at equal distances, on each of which traces and
   * bridges of rock take turns, all of it with scatter. With the direction
   * @f$ d = (\cos\alpha, \sin\alpha) @f$ and its normal @f$ n @f$, line k is
   * @f[ n\cdot x = o + (k + \tfrac{s_s}{2} r)\,s, @f]
   * and trace j on it fills the share p of the period from @f$ (j+\varphi)\,L/p @f$ to
   * @f$ (j+1+\varphi)\,L/p @f$ along d, L being the mean length of a trace, p the
   * persistence, s the spacing, o the offset, and r from [-1, 1] and
   * @f$ \varphi @f$ from [0, 1) random numbers of the line.
   *
   * Intensities: without scatter of dips the length of traces per area is
   * P21 = p / s [1/m], and their number per area P20 = p / (s L) [1/m^2].
   *
   * The random numbers of a line or trace depend on the seed and on k and j alone: a
   * larger solid has more of the same network. They are taken from bits of
   * std::mt19937_64, and coordinates are rounded to about 1e-12 of the solid's
   * size, so that a seed means the same network on every machine.
   */
  struct JointSet
  {
    /// Name of all its joints, by which laws of contact refer to them.
    std::string name;
    /// Angle alpha from the x-axis to the joints, counter-clockwise [degrees].
    double dip = 0.;
    /// Lines are turned by up to this much, about the point that is next to the
    /// middle of the solid [degrees].
    double dip_scatter = 0.;
    /// Between lines [m].
    double spacing = 0.;
    /// s_s, from 0 up to 1: a distance differs by up to this share [-].
    double spacing_scatter = 0.;
    /// p: share of a line that is jointed, above 0 and up to 1 [-]. 1: joints run
    /// through.
    double persistence = 1.;
    /// L [m]; only with a persistence below 1.
    double trace_length = 0.;
    /// Lengths differ by up to this share, at most 1/p - 1 [-].
    double trace_length_scatter = 0.;
    /// Distance of line 0 from the origin, along n = (-sin alpha, cos alpha) [m].
    double       offset = 0.;
    unsigned int seed   = 1;
    JointState   state  = JointState::open;
    /// Curve::within and Curve::drops_ends.
    std::string within;
    bool        drops_ends = false;

    /// @throws InputError naming the set, the value and its limits.
    void
    check() const;
  };


  /**
   * How often joints of different sets are expected to cross, before any is made:
   * @f[ \sum_{a<b} A_{ab}\,\frac{p_a}{s_a}\,\frac{p_b}{s_b}\,
       |\sin(\theta_a-\theta_b)| @f]
   * with persistence p [-], spacing s [m] and dip @f$\theta@f$ of each set: p / s is
   * its length by area, and lines of these lengths by area cross so often if they are
   * placed independently. @f$A_{ab}@f$ is the smaller area of the places that the sets are
   * confined to [m^2], 0 for two regions. Holes and the scatter of dips are left out.
   * @throws InputError for a set that is wrong, a geometry without boundary.
   */
  double
  estimate_crossings(const std::vector<JointSet> &sets,
                     const Geometry              &geometry);


  /**
   * The joints of the set that may meet the solid of @p geometry: segments over its
   * bounding box (or that of the region they are confined to), of which PhysicalMesh
   * takes what is inside. @throws InputError for a set that is wrong, a geometry
   * without boundary, more than a million traces.
   */
  std::vector<Curve>
  make_joints(const JointSet &set, const Geometry &geometry);
} // namespace NMM

#endif
