#ifndef nmm_geometry_geometry_h
#define nmm_geometry_geometry_h

#include <nmm/geometry/curve.h>

#include <string>
#include <utility>
#include <vector>

namespace NMM
{
  /**
   * Description of a physical mesh by the user: named curves with their roles, regions, and
   * material points.
   *
   * A boundary or hole is one closed curve, or several named open ones (so that loads can refer to
   * a side), whose end points coincide exactly and which form closed loops.
   *
   * Order of calls: add() and the other functions that add, or read_geometry(); then clean() if
   * end points do not coincide; then the constructor of PhysicalMesh, which checks the description
   * and finds regions and blocks.
   *
   * A square with a hole and a joint through both:
   * @code
   * Geometry geometry;
   * geometry.add_polygon({Point<2>(0., 0.), Point<2>(1., 0.), Point<2>(1., 1.), Point<2>(0., 1.)},
   *                      "outline");
   * geometry.add_circle(Point<2>(0.5, 0.5), 0.2, "bore", CurveRole::hole);
   * geometry.add_polyline({Point<2>(-1., 0.5), Point<2>(2., 0.5)}, "joint", CurveRole::joint);
   * const PhysicalMesh solid(std::move(geometry));
   * std::cout << solid.n_blocks() << " blocks" << std::endl;
   * @endcode
   */
  class Geometry
  {
  public:
    /**
     * Add a curve; one without a name is named after its role and number.
     * @throws InputError as Curve::check().
     */
    void
    add(Curve curve);

    /// Add a closed polygon with at least three @p vertices [m]; the first one need not be
    /// repeated.
    void
    add_polygon(const std::vector<dealii::Point<2>> &vertices,
                const std::string                   &name,
                CurveRole                            role = CurveRole::boundary,
                const std::string                   &material = "");

    /// Add an open polyline through @p vertices [m], for example a joint.
    void
    add_polyline(const std::vector<dealii::Point<2>> &vertices,
                 const std::string                   &name,
                 CurveRole                            role,
                 JointState                           state = JointState::open);

    /// Add a full circle; @p center and @p radius in [m].
    void
    add_circle(const dealii::Point<2> &center,
               double                  radius,
               const std::string      &name,
               CurveRole               role,
               const std::string      &material = "");

    /// Set the material of the region that contains @p point [m]. If there are several points in a
    /// region, the last one counts.
    void
    add_material_point(const dealii::Point<2> &point,
                       const std::string      &material);

    /**
     * Add a closed curve with a unique name, inside of which other curves can be confined
     * (Curve::within). It is not a part of the physical mesh; its role and state are ignored.
     * @throws InputError as Curve::check(), for a curve that is not closed, and for a name that
     * another region has.
     */
    void
    add_region(Curve curve);

    /// Set the material of all regions of the solid whose point PhysicalMesh::Region::inside is in
    /// the closed curve called @p region. If several calls apply to a region of the solid, the last
    /// one counts; material points take precedence. @throws InputError if there is no such closed
    /// curve.
    void
    add_material_region(const std::string &region, const std::string &material);

    /// Let PhysicalMesh merge blocks smaller than @p area [m^2] into neighbours; 0, the default, lets
    /// all blocks be as they are drawn. @throws InputError if the area is negative or not finite.
    void
    merge_blocks_below(double area);

    /// The area of merge_blocks_below() [m^2].
    double
    merging_area() const;

    /// Let PhysicalMesh take joints of one state that run along each other, nearer than a millionth of
    /// their length, for one line that was drawn twice with other digits. A strip that is so thin
    /// cannot be in contact: any penetration is deeper.
    void
    unite_doubled_joints();

    /// Whether unite_doubled_joints() was called.
    bool
    unites_doubled_joints() const;

    /// All curves in the order in which they were added.
    const std::vector<Curve> &
    curves() const;

    /// The same for changes, which are not checked until PhysicalMesh is made.
    std::vector<Curve> &
    curves();

    /// The closed curves of add_region().
    const std::vector<Curve> &
    regions() const;

    /// Names of closed curves and materials of add_material_region(), in the order of calls.
    const std::vector<std::pair<std::string, std::string>> &
    material_regions() const;

    /// Points [m] and materials of add_material_point(), in the order of calls.
    const std::vector<std::pair<dealii::Point<2>, std::string>> &
    material_points() const;

  private:
    std::vector<Curve>                               all_curves, all_regions;
    std::vector<std::pair<std::string, std::string>> all_material_regions;
    std::vector<std::pair<dealii::Point<2>, std::string>> all_material_points;
    double                                                area_to_merge = 0.;
    bool                                                  unites_joints = false;
  };

  /**
   * Read a geometry file. It has one record per line; a record may continue over several lines
   * until its parentheses close, and `#` starts a comment. doc/scene-format.md describes the
   * format.
   * @throws InputError naming file and line.
   */
  Geometry
  read_geometry(const std::string &file_name);

  /// Read a geometry from a string; messages call it @p source_name.
  Geometry
  parse_geometry(const std::string &text, const std::string &source_name);

  /// One change made by clean(), or a block that PhysicalMesh has merged.
  struct CleaningAction
  {
    /// Kind of a change.
    enum class Kind
    {
      /// An end point was moved to a vertex nearby.
      snapped_to_vertex,
      /// An end point that was short of a curve was moved onto it.
      extended_to_curve,
      /// The part of a curve beyond another one was cut off.
      trimmed_overshoot,
      /// A piece that was not longer than the tolerance was removed.
      removed_piece,
      /// A small block became a part of its neighbour, see PhysicalMesh.
      merged_block
    };

    /// Kind of this change.
    Kind kind;
    /// Name of the curve that was changed; the longest joint between a merged block and its
    /// neighbour.
    std::string curve;
    /// Position of the end point before the change [m]; start of a removed piece; a point inside a
    /// merged block.
    dealii::Point<2> from;
    /// Position of the end point after the change [m]; end of a removed piece; a point inside the
    /// neighbour of a merged block.
    dealii::Point<2> to;
    /// Distance by which the end point was moved [m]; length of a removed piece, or of the joints
    /// between a merged block and its neighbour.
    double distance;
    /// Area of a merged block [m^2]; 0 for other changes.
    double area = 0.;

    /// A sentence for the user that describes the change.
    std::string
    description() const;
  };

  /**
   * Clean the curves of a geometry: snap end points closer than @p tolerance [m] to a vertex or
   * curve, trim overshoots shorter than it, and remove short pieces. A tolerance of 0 changes
   * nothing. Returns all changes in order.
   */
  std::vector<CleaningAction>
  clean(Geometry &geometry, double tolerance);
} // namespace NMM

#endif
