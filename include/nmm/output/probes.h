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
    std::string      name;
    bool             is_line = false;
    dealii::Point<2> point, from, to;
    unsigned int     n_points = 101;
  };


  /**
   * The points of all probes, with the element each lies in. A point within
   * 1e-9 of the solid's size of an element counts as in it, since a point on an
   * arc has rounded coordinates. On a joint, the side is chosen by chance.
   */
  class ProbePoints
  {
  public:
    /**
     * @throws InputError for a point probe outside the solid and for a line that
     * meets it nowhere.
     */
    ProbePoints(const ManifoldMesh &mesh, const std::vector<Probe> &probes);

    struct Entry
    {
      unsigned int     probe;
      unsigned int     index;
      double           distance;
      dealii::Point<2> x;
      /// invalid_index outside the solid.
      unsigned int element;
    };

    const std::vector<Entry> &
    entries() const;

    /**
     * Values at all points, evaluated by the ranks that own the elements and
     * gathered on rank 0; empty outside the solid.
     */
    std::vector<std::optional<FieldSample>>
    evaluate(const CoverSystem &covers, const FieldEvaluator &evaluator) const;

    /**
     * probes.csv: probe, point number, distance from the line's start, x, y,
     * 1 inside or 0 outside the solid, displacement, direct and recovered
     * stress; `nan` outside.
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
