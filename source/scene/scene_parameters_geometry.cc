#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters_geometry.h>

#include <algorithm>
#include <cctype>
#include <scene/parsing.h>

// This file has the parameters of the solid: its geometry, joint sets, traces and regions.
namespace NMM
{
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const Words<CurveRole> roles = {{"joint", CurveRole::joint},
                                    {"boundary", CurveRole::boundary},
                                    {"hole", CurveRole::hole},
                                    {"interface", CurveRole::interface}};

    const Words<bool> end_treatments = {{"keep", false}, {"drop", true}};

    const Words<bool> small_block_treatments = {{"report", false},
                                                {"merge", true}};

    const Words<JointState> joint_states = {{"open", JointState::open},
                                            {"closed", JointState::closed}};

    using Use                    = RegionParameters::Use;
    const Words<Use> region_uses = {{"place", Use::place},
                                    {"excavation", Use::excavation},
                                    {"restraint", Use::restraint},
                                    {"limit", Use::limit},
                                    {"staged", Use::staged}};


    /// Whether a file is a DXF drawing, by its extension.
    bool
    is_drawing(const std::string &file)
    {
      std::string end = file.size() < 4 ? "" : file.substr(file.size() - 4);
      std::transform(end.begin(), end.end(), end.begin(), [](const char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      });
      return end == ".dxf";
    }


    /// Adds the entries that joint sets and traces share.
    void
    add_joint_entries(Entries &entries, JointState &state, std::string &within)
    {
      entries.add("State",
                  state,
                  joint_states,
                  "open: faces do not hold together, but may be in contact; "
                  "closed: they are tied.");
      entries.add("Within",
                  within,
                  "Name of a region, or of the boundary of a domain, outside "
                  "of which there are none. Empty: all of the solid.");
    }
  } // namespace


  void
  GeometryParameters::list_entries(Entries &entries)
  {
    entries.add("File",
                file,
                "Geometry file (WKT records), relative to the folder of the "
                "scene file. Either this or Text.");
    entries.add("Text",
                text,
                "The geometry itself: the records of a geometry file, "
                "separated by semicolons.");
    entries.add(
      "Cleaning tolerance",
      cleaning_tolerance,
      Patterns::Double(0),
      "Before cutting, ends of curves nearer than this to a vertex or curve "
      "are moved onto it and shorter overshoots are trimmed; every change is "
      "reported [m]. 0: the geometry is taken exactly as it is.");
    entries.add("Dangling ends",
                drops_ends,
                end_treatments,
                "What becomes of parts of joints that bound no block. keep: "
                "they are cracks; drop: they do not count.");
    entries.add("Small block area",
                small_block,
                Patterns::Double(0),
                "Blocks smaller than this are small: see Small blocks [m^2]. "
                "0: none are.");
    entries.add("Small blocks",
                merges_small_blocks,
                small_block_treatments,
                "What becomes of small blocks. report: they are counted; "
                "merge: each becomes a part of the block with which it shares "
                "the longest joint, and the joint vanishes there.");
  }


  void
  GeometryParameters::check(const bool has_drawn_outline) const
  {
    AssertThrow(file.empty() != text.empty() ||
                  (file.empty() && has_drawn_outline),
                InputError(file.empty() ? "the scene has no geometry"
                                        : "the scene has two geometries",
                           "section 'Geometry'",
                           "set either 'File' or 'Text', or take the outline "
                           "from a drawing in section 'Traces'"));
    AssertThrow(!merges_small_blocks || small_block > 0.,
                InputError("small blocks are merged, but none is small",
                           "parameter 'Geometry/Small blocks'",
                           "set 'Small block area' to the area below which a "
                           "block is merged"));
    AssertThrow(!is_drawing(file),
                InputError("a drawing does not say what its curves are",
                           "parameter 'Geometry/File'",
                           "read it in section 'Traces', with 'Role = "
                           "boundary' for the layers of the outline"));
  }


  void
  JointSetParameters::list_entries(Entries &entries, JointSet &set)
  {
    const auto number = [&](const char *key, double &value, const char *help) {
      entries.add(key, value, Patterns::Double(), help);
    };
    number("Dip",
           set.dip,
           "Angle from the x-axis to the joints, counter-clockwise [degrees]: "
           "60 rises to the right, -60 to the left.");
    number("Dip scatter",
           set.dip_scatter,
           "Each line is turned by up to this, either way [degrees].");
    number("Spacing", set.spacing, "Distance between lines, > 0 [m].");
    number("Spacing scatter",
           set.spacing_scatter,
           "Distances differ by up to this share, below 1 [-].");
    number("Persistence",
           set.persistence,
           "Share of a line that is jointed, above 0 [-]; the rest is bridges "
           "of rock. 1: joints run through.");
    number("Trace length",
           set.trace_length,
           "Mean length of a joint between two bridges [m]; with a persistence "
           "below 1.");
    number(
      "Trace length scatter",
      set.trace_length_scatter,
      "Lengths differ by up to this share, at most 1 / persistence - 1 [-].");
    number("Offset",
           set.offset,
           "Distance of a line from the origin, to the left of the direction "
           "of the dip [m].");
    entries.add("Seed",
                set.seed,
                Patterns::Integer(0, 2147483647),
                "Another number makes another network; the same makes the same "
                "on every machine.");
    add_joint_entries(entries, set.state, set.within);
    if (entries.are_parsed())
      set.check();
  }


  void
  TraceParameters::list_entries(Entries &entries)
  {
    entries.add("File",
                file,
                "DXF drawing (its name ends in .dxf) or geometry file with "
                "joints, relative to the folder of the scene file.");
    entries.add("Layers", layers, "Drawing: layers that are read. Empty: all.");
    entries.add("Role",
                role,
                roles,
                "Drawing: what its curves are, as in a geometry file.");
    entries.add("Material",
                material,
                "Drawing: material in boundaries or in closed interfaces. "
                "Empty: what the geometry says.");
    entries.add("Label",
                label,
                "What all curves of the file are called. Empty: after their "
                "layers, or what the geometry file says.");
    add_joint_entries(entries, state, within);
  }


  bool
  TraceParameters::is_drawing() const
  {
    return NMM::is_drawing(file);
  }


  void
  TraceParameters::check() const
  {
    AssertThrow(!file.empty(),
                InputError("the traces '" + name + "' have no file",
                           "section 'Traces/" + name + "'",
                           "set 'File' to a DXF drawing or a geometry file"));
    AssertThrow(is_drawing() || layers.empty(),
                InputError("layers would not be used by the geometry file '" +
                             file + "'",
                           "parameter 'Traces/" + name + "/Layers'",
                           "remove it, or name a file that ends in .dxf"));
    const std::string section = "Traces/" + name;
    const auto        unused  = [&](const std::string &key,
                            const std::string &value,
                            const std::string &by) {
      AssertThrow(value.empty(),
                  UnusedValue(section, key, value, by, "remove it"));
    };
    if (!is_drawing())
      unused("Role",
             role == CurveRole::joint ? "" : to_string(role),
             "a geometry file, which says itself what its curves are");
    const std::string by = "curves with 'Role = " + to_string(role) + "'";
    if (role == CurveRole::joint || role == CurveRole::hole)
      unused("Material", material, by);
    if (role == CurveRole::joint)
      return;
    unused("State", state == JointState::closed ? "closed" : "", by);
    unused("Within", within, by);
  }


  void
  RegionParameters::list_entries(Entries &entries)
  {
    entries.add("Shape",
                shape,
                "A closed shape as in geometry files: POLYGON (...), "
                "CURVEPOLYGON (...) or CIRCLE (...). Either this or File.");
    entries.add("File",
                file,
                "Geometry file, relative to the folder of the scene file, with "
                "a record of one closed curve.");
    entries.add(
      "Use",
      use,
      region_uses,
      "place: for 'Material' here and 'Within' of joint sets; excavation: what "
      "is inside is no part of the solid; restraint: the same, and in its "
      "place is a rigid body that holds the solid until it is released; limit, "
      "dynamic analysis: blocks that are wholly outside of all limits are "
      "dropped; staged: tied to what is around it until a stage removes it.");
    entries.add("Material",
                material,
                "Material of the blocks with their middle inside. Empty: that "
                "of the geometry.");
    entries.add("Release time",
                release_time,
                Patterns::Double(),
                "restraint, dynamic analysis: it is gone from this time on "
                "[s]. Negative: never.");
  }


  void
  RegionParameters::check() const
  {
    const std::string section = "'Regions/" + name;
    AssertThrow(shape.empty() != file.empty(),
                InputError("the region '" + name + "' has " +
                             (shape.empty() ? "no" : "more than one") +
                             " shape",
                           "section " + section + "'",
                           "set either 'Shape' or 'File'"));
    AssertThrow(
      use == Use::place || use == Use::staged || material.empty(),
      InputError("the material '" + material +
                   (use == Use::limit
                      ? "' is of a limit, which is no place"
                      : "' is of a region from which the solid is taken out"),
                 "parameter " + section + "/Material'",
                 "remove it, or set 'Use = place'"));
    if (use != Use::restraint)
      expect_default("Regions/" + name,
                     "Release time",
                     release_time,
                     -1.,
                     "a region that is no restraint",
                     "remove it, or set 'Use = restraint'");
  }
} // namespace NMM
