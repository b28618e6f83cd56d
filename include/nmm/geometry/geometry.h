#ifndef nmm_geometry_geometry_h
#define nmm_geometry_geometry_h

#include <nmm/geometry/curve.h>

#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  /**
   * The description of a physical mesh, as a user gives it: named curves with
   * their roles, and material points. It is only collected here; PhysicalMesh
   * checks it and works out blocks.
   *
   * Boundaries and holes may come as one closed curve or as several named open
   * ones (so that loads can name a side) whose end points coincide exactly and
   * which then chain to closed loops.
   */
  class Geometry
  {
  public:
    /**
     * Add a curve. @throws InputError for a non-finite coordinate, a piece of
     * zero length, a radius that is not positive, collinear arc points, pieces
     * that do not follow each other, no piece at all.
     */
    void
    add(Curve curve);

    /// Closed polygon (first point need not be repeated) as outer boundary.
    void
    add_polygon(const std::vector<dealii::Point<2>> &vertices,
                const std::string                   &name,
                CurveRole                            role = CurveRole::boundary,
                const std::string                   &material = "");

    /// Open polyline, e.g. a joint.
    void
    add_polyline(const std::vector<dealii::Point<2>> &vertices,
                 const std::string                   &name,
                 CurveRole                            role,
                 JointState                           state = JointState::open);

    /// Full circle.
    void
    add_circle(const dealii::Point<2> &center,
               double                  radius,
               const std::string      &name,
               CurveRole               role,
               const std::string      &material = "");

    /// The region around @p point consists of @p material. Later ones win.
    void
    add_material_point(const dealii::Point<2> &point,
                       const std::string      &material);

    /**
     * A place that curves can be confined to (Curve::within), and that is no part of
     * the physical mesh itself: a closed curve with a name of its own. Role and
     * state mean nothing. @throws InputError unless it is closed, as for add(), and
     * for a name that another region has.
     */
    void
    add_region(Curve curve);

    /// All regions of the solid whose point PhysicalMesh::Region::inside is in the
    /// region called @p region consist of @p material; later ones win, material
    /// points over all. @throws InputError for a region that does not exist.
    void
    add_material_region(const std::string &region, const std::string &material);

    const std::vector<Curve> &
    curves() const;

    std::vector<Curve> &
    curves();

    const std::vector<Curve> &
    regions() const;

    /// Names of regions and their materials.
    const std::vector<std::pair<std::string, std::string>> &
    material_regions() const;

    const std::vector<std::pair<dealii::Point<2>, std::string>> &
    material_points() const;

  private:
    std::vector<Curve>                               all_curves, all_regions;
    std::vector<std::pair<std::string, std::string>> all_material_regions;
    std::vector<std::pair<dealii::Point<2>, std::string>> all_material_points;
  };

  /**
   * Read a geometry file: one record per line (a record may go on over several
   * lines until its parentheses close), `#` starts a comment. The format is in
   * doc/scene-format.md.
   * @throws InputError naming file and line.
   */
  Geometry
  read_geometry(const std::string &file_name);

  /// The same from a string; @p source_name stands in messages.
  Geometry
  parse_geometry(const std::string &text, const std::string &source_name);

  /// One change made by clean().
  struct CleaningAction
  {
    enum class Kind
    {
      /// An end point moved onto a near-coincident vertex.
      snapped_to_vertex,
      /// An end point short of a curve moved onto it.
      extended_to_curve,
      /// An overshoot past a curve cut off.
      trimmed_overshoot,
      /// A piece shorter than the tolerance removed.
      removed_piece
    };

    Kind             kind;
    std::string      curve;
    dealii::Point<2> from, to;
    double           distance;

    std::string
    description() const;
  };

  /**
   * The cleaning step: snap end points closer than @p tolerance [m] to a vertex
   * or curve, trim overshoots shorter than it. Off for tolerance 0. Returns
   * every change made, in order.
   */
  std::vector<CleaningAction>
  clean(Geometry &geometry, double tolerance);
} // namespace NMM

#endif
