#ifndef nmm_output_probes_h
#define nmm_output_probes_h

#include <nmm/output/field_samples.h>

#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace NMM
{
  /// A point, or points along a line, at which the solution is written.
  struct Probe
  {
    /// Name in the table and in messages.
    std::string name;
    /// Whether the probe is a line instead of a point.
    bool is_line = false;
    /// The point in the reference configuration [m]; not used by a line.
    dealii::Point<2> point;
    /// Start of the line [m].
    dealii::Point<2> from;
    /// End of the line [m].
    dealii::Point<2> to;
    /// Number of points on the line, ends included; they are at equal distances.
    unsigned int n_points = 101;
  };


  /**
   * The points of all probes, each with the element that contains it. A point whose distance
   * from an element is within 1e-9 of the solid's size counts as in it, since a point on an
   * arc has rounded coordinates. Of a point on a joint, the side is arbitrary.
   */
  class ProbePoints
  {
  public:
    /**
     * Finds the elements of all points.
     * @throws InputError for a point probe outside the solid, and for a line without any point in
     * it.
     */
    ProbePoints(const ManifoldMesh &mesh, const std::vector<Probe> &probes);

    /// One of the points.
    struct Entry
    {
      /// Index of the probe in the list given to the constructor.
      unsigned int probe;
      /// Number of the point within its probe, from 0 on.
      unsigned int index;
      /// Distance from the start of the line [m]; 0 for a point probe.
      double distance;
      /// Position in the reference configuration [m].
      dealii::Point<2> x;
      /// The manifold element that contains the point; invalid_index outside the solid.
      unsigned int element;
    };

    /// All points, probe by probe.
    const std::vector<Entry> &
    entries() const;

    /**
     * Displacements and stresses at all points, in the order of entries(). They are evaluated by
     * the ranks that own the elements and gathered on rank 0, without velocity and plastic strain.
     * Values are empty outside the solid, and on other ranks. Collective.
     */
    std::vector<std::optional<FieldSample>>
    evaluate(const CoverSystem &covers, const FieldEvaluator &evaluator) const;

    /**
     * Writes the table probes.csv with a row per point: the probe, the number of the point, its
     * distance from the start of the line, x, y, 1 inside or 0 outside the solid, displacement,
     * direct and recovered stress; `nan` stands for values outside.
     */
    void
    write(std::ostream                                  &out,
          const std::vector<std::optional<FieldSample>> &samples) const;

  private:
    std::vector<std::string> names;
    std::vector<Entry>       all_entries;
  };
} // namespace NMM

#endif
