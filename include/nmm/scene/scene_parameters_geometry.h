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
   * The sections of a scene file. Every struct lists the entries of its
   * own section, which declares and parses them, and checks what patterns cannot
   * express. Units are any consistent set; the help texts name SI ones.
   *
   * Sections that hold a list have an entry `Names`; each name has a
   * subsection of its own, so the list must be known before the entries can be
   * declared: see SceneNames.
   */

  /// The section `Geometry`.
  struct GeometryParameters
  {
    /// WKT geometry file, relative to the scene file; empty: `text` is used.
    std::string file;
    /// Geometry records separated by semicolons.
    std::string text;
    /// Tolerance of the cleaning step [m]; 0: off.
    double cleaning_tolerance = 0.;
    /// Joints lose what bounds no block.
    bool drops_ends = false;
    /// Blocks with a smaller area are reported [m^2]; 0: none are.
    double small_block = 0.;

    void
    list_entries(internal::Entries &entries);
    void
    check() const;
  };


  /// A set of joints: a subsection of `Joint sets`. See JointSet.
  struct JointSetParameters
  {
    /// @throws InputError for a value that is wrong.
    static void
    list_entries(internal::Entries &entries, JointSet &set);
  };


  /// Joints from a file of their own: a subsection of `Traces`.
  struct TraceParameters
  {
    std::string name;
    /// DXF drawing (.dxf) or geometry file, relative to the scene file.
    std::string file;
    /// Layers of a drawing that are read; empty: all of them.
    std::vector<std::string> layers;
    /// What all are called; empty: after their layers, or as in the file.
    std::string label;
    JointState  state = JointState::open;
    std::string within;

    bool
    is_drawing() const;

    void
    list_entries(internal::Entries &entries);
    void
    check() const;
  };


  /// A place in the scene: a subsection of `Regions`.
  struct RegionParameters
  {
    enum class Use
    {
      /// For materials and joint sets only.
      place,
      /// What is inside is taken out of the solid.
      excavation,
      /// The same, and a rigid body is in its place until it is released.
      restraint,
      /// Blocks that leave it are dropped.
      limit
    };

    std::string name;
    /// A closed shape, or a geometry file with one.
    std::string shape, file;
    Use         use = Use::place;
    /// Material of the blocks inside; empty: it does not change.
    std::string material;
    /// Restraint [s]; negative: never.
    double release_time = -1.;

    void
    list_entries(internal::Entries &entries);
    void
    check() const;
  };
} // namespace NMM

#endif
