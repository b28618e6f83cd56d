#ifndef nmm_scene_scene_parameters_geometry_h
#define nmm_scene_scene_parameters_geometry_h

#include <nmm/geometry/joint_network.h>

#include <string>
#include <vector>

namespace NMM
{
  namespace internal
  {
    class Entries;
  }

  /**
   * The sections of a scene file. In each struct the function `list_entries` declares or reads the
   * entries of its section, and `check` checks what patterns cannot
   * express. Any consistent set of units can be used; the help texts name SI units.
   *
   * Sections that hold a list have an entry `Names`. Each name has a
   * subsection of its own, so the list must be known before the entries can be
   * declared; see SceneNames.
   */

  /// The section `Geometry`.
  struct GeometryParameters
  {
    /// WKT geometry file, relative to the scene file; empty if it is not used.
    std::string file;
    /// Geometry records separated by semicolons; empty if they are not used.
    std::string text;
    /// Tolerance of the cleaning step [m]; 0 if there is no cleaning.
    double cleaning_tolerance = 0.;
    /// Whether the parts of joints that bound no block are removed.
    bool drops_ends = false;
    /// Area below which blocks are reported, or merged [m^2]; 0 if none is.
    double small_block = 0.;
    /// Whether small blocks are merged into neighbours.
    bool merges_small_blocks = false;

    /// Declares or reads the entries of the section.
    void
    list_entries(internal::Entries &entries);
    /// Checks that there is one geometry, or none if drawings have the outlines, and that blocks are
    /// merged below an area only. @throws InputError otherwise.
    void
    check(bool has_drawn_outline) const;
  };


  /// A set of joints: a subsection of `Joint sets`. See JointSet.
  struct JointSetParameters
  {
    /// Declares or reads the entries of @p set. @throws InputError for a value that is wrong.
    static void
    list_entries(internal::Entries &entries, JointSet &set);
  };


  /// Curves from a file of their own: a subsection of `Traces`.
  struct TraceParameters
  {
    /// Name of the subsection, for messages.
    std::string name;
    /// DXF drawing (.dxf) or geometry file, relative to the scene file.
    std::string file;
    /// Layers of a drawing that are read; if empty, all are read.
    std::vector<std::string> layers;
    /// What the curves of a drawing are. Those of a geometry file are joints.
    CurveRole role = CurveRole::joint;
    /// Material in the closed curves of a drawing that are boundaries or interfaces; may be empty.
    std::string material;
    /// Name of all curves from this file; if empty, curves are called after their layers in a
    /// drawing, or as the geometry file says.
    std::string label;
    /// Whether the joints are open or closed.
    JointState state = JointState::open;
    /// Name of the region, or of the boundary of a domain, to which joints are cut; empty for all
    /// of the solid.
    std::string within;

    /// Whether the file is a DXF drawing, by its extension.
    bool
    is_drawing() const;

    /// Declares or reads the entries of the subsection.
    void
    list_entries(internal::Entries &entries);
    /// Checks that there is a file, and that all values are used. @throws InputError otherwise.
    void
    check() const;
  };


  /// A place in the scene: a subsection of `Regions`.
  struct RegionParameters
  {
    /// The effect of a region.
    enum class Use
    {
      /// The region can have a material, and joint sets and traces can refer to it.
      place,
      /// The part of the solid inside the region is removed.
      excavation,
      /// The part inside is removed, and a rigid body takes its place until it is released.
      restraint,
      /// Blocks that lie outside of all regions with this use are removed.
      limit,
      /// A tied joint surrounds the part inside, which a stage can remove.
      staged
    };

    /// Name of the subsection, by which joint sets and traces refer to the region.
    std::string name;
    /// Closed shape as a record of a geometry file; empty if `file` is given.
    std::string shape;
    /// Geometry file with a closed shape, relative to the scene file; empty if `shape` is given.
    std::string file;
    /// The effect of the region.
    Use use = Use::place;
    /// Material of the blocks whose middle is inside; if empty, they keep theirs.
    std::string material;
    /// Time from which on a restraint is removed [s]; a negative time stands for never.
    double release_time = -1.;

    /// Declares or reads the entries of the subsection.
    void
    list_entries(internal::Entries &entries);
    /// Checks that there is one shape, and that all values are used. @throws InputError otherwise.
    void
    check() const;
  };
} // namespace NMM

#endif
