#include <nmm/base/exceptions.h>
#include <nmm/base/memory.h>
#include <nmm/geometry/dxf.h>
#include <nmm/geometry/joint_network.h>
#include <nmm/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <scene/shapes.h>
#include <sstream>

// This file makes the geometry of a scene: boundaries, joints and regions.
namespace NMM
{
  void
  Scene::add_traces(const TraceParameters    &parameters,
                    Geometry                 &geometry,
                    std::vector<std::string> *notices) const
  {
    const std::string path = relative_to_scene(parameters.file);
    Drawing           drawing;
    if (parameters.is_drawing())
      drawing = read_dxf(path, parameters.layers);
    else
      drawing.curves = read_geometry(path).curves();
    const std::string &length_unit = scene_parameters.output.length_unit;
    // Several layers of one drawing are reported once.
    const auto report = [notices](const std::string &text) {
      if (notices != nullptr && !text.empty() &&
          std::find(notices->begin(), notices->end(), text) == notices->end())
        notices->push_back(text);
    };
    report(drawing.notice);
    if (!drawing.unit.empty() && drawing.unit != length_unit)
      report("the drawing " + parameters.file + " says that its unit is " +
             drawing.unit +
             " ($INSUNITS), but its coordinates are taken as they "
             "are, in " +
             length_unit + ", the scene's unit of length");
    for (Curve &curve : drawing.curves)
    {
      AssertThrow(curve.role == CurveRole::joint,
                  InputError("the traces '" + parameters.name +
                               "' contain the " + to_string(curve.role) + " '" +
                               curve.name + "'",
                             curve.source,
                             "let the file have joints only, and put the "
                             "rest into the section 'Geometry'"));
      if (!parameters.label.empty())
        curve.name = parameters.label;
      // A drawing does not say whether joints are open, but a geometry file may.
      if (parameters.is_drawing() || parameters.state == JointState::closed)
        curve.state = parameters.state;
      curve.role       = parameters.role;
      curve.material   = parameters.material;
      curve.within     = parameters.within;
      curve.is_clipped = curve.role == CurveRole::joint;
      geometry.add(std::move(curve));
    }
  }


  namespace
  {
    /// Checks the memory for the blocks that joint sets make, and for the cells that they cut,
    /// which are of the size @p cell_size [m] (0: unknown). @throws InputError if joints cross so
    /// often, or are so long, that it does not suffice.
    void
    check_joint_sets(const std::vector<JointSet> &sets,
                     const Geometry              &geometry,
                     const double                 cell_size)
    {
      // Memory per crossing for a block and its own mesh [bytes], measured on
      // tests/scenes/network-square with 1e4 to 1.6e5 crossings (`peak_memory` in the summary).
      constexpr double of_crossing = 3e4;
      // Memory of a cell without factors [bytes], see estimate_memory() in scene.cc.
      constexpr double of_cell     = 2e3;
      const double     n_crossings = estimate_crossings(sets, geometry);
      const double     n_cells =
        cell_size > 0. ? estimate_length(sets, geometry) / cell_size : 0.;
      std::ostringstream number;
      number << std::setprecision(2) << n_crossings
             << " crossings of joint sets and " << n_cells
             << " cells that joints cut";
      require_memory(of_crossing * n_crossings + of_cell * n_cells,
                     available_memory(1u),
                     number.str(),
                     "the spacings in section 'Joint sets'",
                     [&](const double excess) {
                       // The advice is a little larger than the value that just fits.
                       const double factor =
                         1.05 * (of_crossing * n_crossings > of_cell * n_cells
                                   ? std::sqrt(excess)
                                   : excess);
                       std::ostringstream text;
                       text << std::setprecision(2)
                            << "choose spacings of at least";
                       for (std::size_t i = 0; i < sets.size(); ++i)
                         text << (i == 0 ? " " : ", ")
                              << factor * sets[i].spacing << " m for '"
                              << sets[i].name << '\'';
                       text
                         << ", larger cells, or a machine or limit with more "
                            "memory";
                       return text.str();
                     });
    }
  } // namespace


  Curve
  Scene::make_region(const RegionParameters &parameters) const
  {
    Curve curve = internal::read_shape(parameters.shape,
                                       parameters.file.empty()
                                         ? ""
                                         : relative_to_scene(parameters.file),
                                       "Regions/" + parameters.name,
                                       file_name);
    curve.name  = parameters.name;
    curve.material.clear();
    AssertThrow(curve.is_closed(),
                InputError("the region '" + parameters.name + "' is not closed",
                           "section 'Regions/" + parameters.name + "'",
                           "give a POLYGON, CURVEPOLYGON or CIRCLE"));
    return curve;
  }


  std::vector<Curve>
  Scene::make_limits() const
  {
    std::vector<Curve> limits;
    for (const RegionParameters &parameters : scene_parameters.regions)
      if (parameters.use == RegionParameters::Use::limit)
        limits.push_back(make_region(parameters));
    return limits;
  }


  void
  Scene::add_regions(Geometry &geometry) const
  {
    using Use = RegionParameters::Use;
    for (const RegionParameters &parameters : scene_parameters.regions)
    {
      Curve       region = make_region(parameters);
      const auto &curves = geometry.curves();
      const bool  is_unnamed =
        std::none_of(curves.begin(), curves.end(), [&](const Curve &curve) {
          return curve.name == parameters.name;
        });
      AssertThrow(is_unnamed,
                  InputError("a curve of the geometry is called '" +
                               parameters.name + "', too",
                             "parameter 'Regions/Names'",
                             "give the region another name"));
      geometry.add_region(region);
      if (!parameters.material.empty())
        geometry.add_material_region(parameters.name, parameters.material);
      if (parameters.use == Use::place || parameters.use == Use::limit)
        continue;
      if (parameters.use == Use::staged)
      {
        region.role  = CurveRole::joint;
        region.state = JointState::closed;
        geometry.add(std::move(region));
        continue;
      }
      // The hole has the faces that the region leaves. Faces of a restraint must not have the name
      // of the rigid body that holds them.
      region.role       = CurveRole::hole;
      region.is_clipped = true;
      if (parameters.use == Use::restraint)
        region.name += " face";
      geometry.add(std::move(region));
    }
  }


  Geometry
  Scene::make_geometry(std::vector<std::string> *notices) const
  {
    const GeometryParameters &parameters = scene_parameters.geometry;
    std::string               text       = parameters.text;
    std::replace(text.begin(), text.end(), ';', '\n');
    Geometry geometry =
      parameters.file.empty()
        ? parse_geometry(text, file_name + ", parameter 'Geometry/Text'")
        : read_geometry(relative_to_scene(parameters.file));
    for (const TraceParameters &traces : scene_parameters.traces)
      add_traces(traces, geometry, notices);
    add_regions(geometry);
    check_joint_sets(scene_parameters.joint_sets,
                     geometry,
                     scene_parameters.mathematical_mesh.regular.cell_size);
    for (const JointSet &set : scene_parameters.joint_sets)
      for (Curve &joint : make_joints(set, geometry))
        geometry.add(std::move(joint));
    set_joint_states(geometry);
    if (parameters.drops_ends)
      for (Curve &curve : geometry.curves())
        curve.drops_ends = curve.role == CurveRole::joint;
    if (scene_parameters.contact.is_present())
      geometry.unite_doubled_joints();
    if (parameters.merges_small_blocks)
      geometry.merge_blocks_below(parameters.small_block);
    return geometry;
  }
} // namespace NMM
