#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters_geometry.h>

#include <algorithm>
#include <cctype>
#include <scene/parsing.h>

// The solid: its geometry, joint sets, traces and regions.
namespace NMM
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const std::vector<std::pair<std::string, bool>> end_treatments =
      {{"keep", false}, {"drop", true}};

    const std::vector<std::pair<std::string, JointState>> joint_states =
      {{"open", JointState::open}, {"closed", JointState::closed}};

    using Use = RegionParameters::Use;
    const std::vector<std::pair<std::string, Use>> region_uses = {
      {"place", Use::place},
      {"excavation", Use::excavation},
      {"restraint", Use::restraint},
      {"limit", Use::limit}};


    void
    declare_state(ParameterHandler &prm)
    {
      prm.declare_entry("State",
                        "open",
                        selection(joint_states),
                        "open: faces do not hold together, but may be in "
                        "contact; closed: they are tied.");
    }


    void
    declare_within(ParameterHandler &prm)
    {
      prm.declare_entry("Within",
                        "",
                        Patterns::Anything(),
                        "Name of a region, or of the boundary of a domain, "
                        "outside of which there are none. Empty: all of the "
                        "solid.");
    }
  } // namespace


  void
  GeometryParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("File",
                      "",
                      Patterns::Anything(),
                      "Geometry file (WKT records), relative to the folder of "
                      "the scene file. Either this or Text.");
    prm.declare_entry("Text",
                      "",
                      Patterns::Anything(),
                      "The geometry itself: the records of a geometry file, "
                      "separated by semicolons.");
    prm.declare_entry(
      "Cleaning tolerance",
      "0",
      Patterns::Double(0),
      "Before cutting, ends of curves nearer than this to a "
      "vertex or curve are moved onto it and shorter overshoots "
      "are trimmed; every change is reported [m]. 0: the "
      "geometry is taken exactly as it is.");
    prm.declare_entry("Dangling ends",
                      "keep",
                      selection(end_treatments),
                      "What becomes of parts of joints that bound no block. "
                      "keep: they are cracks; drop: they do not count.");
    prm.declare_entry("Small block area",
                      "0",
                      Patterns::Double(0),
                      "Blocks smaller than this are told of [m^2].");
  }


  void
  GeometryParameters::parse(ParameterHandler &prm)
  {
    file               = prm.get("File");
    text               = prm.get("Text");
    cleaning_tolerance = prm.get_double("Cleaning tolerance");
    drops_ends         = get_selection(prm, "Dangling ends", end_treatments);
    small_block        = prm.get_double("Small block area");
  }


  void
  GeometryParameters::check() const
  {
    AssertThrow(file.empty() != text.empty(),
                InputError(file.empty() ? "the scene has no geometry"
                                        : "the scene has two geometries",
                           "section 'Geometry'",
                           "set either 'File' or 'Text'"));
  }


  void
  JointSetParameters::declare(ParameterHandler &prm)
  {
    const auto number =
      [&](const char *key, const char *value, const char *help) {
        prm.declare_entry(key, value, Patterns::Double(), help);
      };
    number("Dip",
           "0",
           "Angle from the x-axis to the joints, counter-clockwise [degrees]: "
           "60 rises to the right, -60 to the left.");
    number("Dip scatter",
           "0",
           "Each line is turned by up to this, either way [degrees].");
    number("Spacing", "0", "Distance between lines, > 0 [m].");
    number("Spacing scatter",
           "0",
           "Distances differ by up to this share, below 1 [-].");
    number("Persistence",
           "1",
           "Share of a line that is jointed, above 0 [-]; the rest is bridges "
           "of rock. 1: joints run through.");
    number("Trace length",
           "0",
           "Mean length of a joint between two bridges [m]; with a persistence "
           "below 1.");
    number("Trace length scatter",
           "0",
           "Lengths differ by up to this share, at most 1 / persistence - 1 "
           "[-].");
    number("Offset",
           "0",
           "Distance of a line from the origin, to the left of the direction "
           "of the dip [m].");
    prm.declare_entry("Seed",
                      "1",
                      Patterns::Integer(0, 2147483647),
                      "Another number makes another network; the same makes "
                      "the same on every machine.");
    declare_state(prm);
    declare_within(prm);
  }


  JointSet
  JointSetParameters::parse(ParameterHandler &prm, const std::string &name)
  {
    JointSet set;
    set.name                 = name;
    set.dip                  = prm.get_double("Dip");
    set.dip_scatter          = prm.get_double("Dip scatter");
    set.spacing              = prm.get_double("Spacing");
    set.spacing_scatter      = prm.get_double("Spacing scatter");
    set.persistence          = prm.get_double("Persistence");
    set.trace_length         = prm.get_double("Trace length");
    set.trace_length_scatter = prm.get_double("Trace length scatter");
    set.offset               = prm.get_double("Offset");
    set.seed                 = prm.get_integer("Seed");
    set.state                = get_selection(prm, "State", joint_states);
    set.within               = dealii::Utilities::trim(prm.get("Within"));
    set.check();
    return set;
  }


  void
  TraceParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("File",
                      "",
                      Patterns::Anything(),
                      "DXF drawing (its name ends in .dxf) or geometry file "
                      "with joints, relative to the folder of the scene file.");
    prm.declare_entry("Layers",
                      "",
                      Patterns::List(Patterns::Anything(), 0),
                      "Drawing: layers that are read. Empty: all.");
    prm.declare_entry("Label",
                      "",
                      Patterns::Anything(),
                      "What all joints of the file are called. Empty: after "
                      "their layers, or what the geometry file says.");
    declare_state(prm);
    declare_within(prm);
  }


  bool
  TraceParameters::is_drawing() const
  {
    std::string end = file.size() < 4 ? "" : file.substr(file.size() - 4);
    std::transform(end.begin(), end.end(), end.begin(), [](const char c) {
      return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    return end == ".dxf";
  }


  void
  TraceParameters::parse(ParameterHandler &prm)
  {
    file   = dealii::Utilities::trim(prm.get("File"));
    layers = get_names(prm, "Layers");
    label  = dealii::Utilities::trim(prm.get("Label"));
    state  = get_selection(prm, "State", joint_states);
    within = dealii::Utilities::trim(prm.get("Within"));
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
  }


  void
  RegionParameters::declare(ParameterHandler &prm)
  {
    prm.declare_entry("Shape",
                      "",
                      Patterns::Anything(),
                      "A closed shape as in geometry files: POLYGON (...), "
                      "CURVEPOLYGON (...) or CIRCLE (...). Either this or "
                      "File.");
    prm.declare_entry("File",
                      "",
                      Patterns::Anything(),
                      "Geometry file, relative to the folder of the scene "
                      "file, with a record of one closed curve.");
    prm.declare_entry("Use",
                      "place",
                      selection(region_uses),
                      "place: for 'Material' here and 'Within' of joint sets; "
                      "excavation: what is inside is no part of the solid; "
                      "restraint: the same, and in its place is a rigid body "
                      "that holds the solid until it is released; limit, "
                      "dynamic analysis: blocks that are wholly outside of all "
                      "limits are dropped.");
    prm.declare_entry("Material",
                      "",
                      Patterns::Anything(),
                      "Material of the blocks with their middle inside. Empty: "
                      "that of the geometry.");
    prm.declare_entry("Release time",
                      "-1",
                      Patterns::Double(),
                      "restraint, dynamic analysis: it is gone from this time "
                      "on [s]. Negative: never.");
  }


  void
  RegionParameters::parse(ParameterHandler &prm)
  {
    shape        = dealii::Utilities::trim(prm.get("Shape"));
    file         = dealii::Utilities::trim(prm.get("File"));
    use          = get_selection(prm, "Use", region_uses);
    material     = dealii::Utilities::trim(prm.get("Material"));
    release_time = prm.get_double("Release time");
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
    AssertThrow(use == Use::place || material.empty(),
                InputError("the material '" + material +
                             (use == Use::limit
                                ? "' is of a limit, which is no place"
                                : "' is of a region from which the solid is "
                                  "taken out"),
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
