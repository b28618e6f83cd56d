#include <nmm/base/exceptions.h>
#include <nmm/geometry/geometry.h>
#include <nmm/scene/scene_parameters_bolts.h>

#include <limits>
#include <scene/parsing.h>

// This file has the parameters of bolts.
namespace NMM
{
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    const Words<Bolt::Type> bolt_types = {{"grouted", Bolt::Type::grouted},
                                          {"end-anchored",
                                           Bolt::Type::end_anchored}};


    /// Text of paths with a record for each line.
    std::string
    as_records(const std::string &paths)
    {
      std::string text = "interface name=path ";
      for (const char c : paths)
        text +=
          c == ';' ? std::string("\ninterface name=path ") : std::string(1, c);
      return text;
    }
  } // namespace


  BoltParameters::BoltParameters()
  {
    for (double *limit : {&bolt.bond_strength,
                          &bolt.yield_force,
                          &bolt.rupture_strain,
                          &bolt.grouted_length})
      *limit = 0.;
  }


  void
  BoltParameters::list_entries(Entries &entries)
  {
    entries.add("Path",
                paths,
                "LINESTRING (...) from the head to the toe, through blocks and "
                "across joints; it need not fit the mesh. Several lines, "
                "separated by semicolons, are equal bolts.");
    entries.add("Type",
                bolt.type,
                bolt_types,
                "grouted: bonded to the rock along its length; end-anchored: "
                "fastened at head and toe only.");
    const auto add = [&](const char *key, double &value, const char *help) {
      entries.add(key, value, Patterns::Double(0.), help);
    };
    add("Young's modulus", bolt.youngs_modulus, "Of the bar, > 0 [Pa].");
    add("Area", bolt.area, "Cross-section of the bar, > 0 [m^2].");
    add("Bond stiffness",
        bolt.bond_stiffness,
        "grouted: shear force between bar and rock per length and slip, > 0 "
        "[N/m^2].");
    add("Bond strength",
        bolt.bond_strength,
        "grouted: largest shear force per length [N/m]; 0: no limit.");
    add("Grouted length",
        bolt.grouted_length,
        "grouted: length from the toe that is grouted; the rest is free [m]; "
        "0: all of it.");
    add("Yield force",
        bolt.yield_force,
        "Axial force at which the bar yields [N]; 0: never.");
    add("Rupture strain",
        bolt.rupture_strain,
        "Mean strain over ten diameters at which the bar breaks [-]; 0: "
        "never.");
    add("Pretension",
        bolt.pretension,
        "Axial force at the head when the bolt is installed [N].");
    add("Spacing",
        bolt.spacing,
        "Distance between bolts out of the plane, > 0 [m]. All stiffnesses, "
        "strengths and forces are those of one bolt and are divided by it.");
    entries.add("Faceplate",
                bolt.faceplate,
                "grouted: whether the head is fastened to the rock. A "
                "pretension needs it.");
    add("Dowel stiffness",
        bolt.dowel_stiffness,
        "grouted: shear force over the slip of a joint that the bolt crosses "
        "[N/m].");
    add("Bedding stiffness",
        bolt.bedding_stiffness,
        "grouted: force per length and deflection of the grout that beds the "
        "bar [N/m^2], instead of the dowel stiffness, which follows from it "
        "for a round bar.");
  }


  std::vector<Bolt>
  BoltParameters::make_bolts(const double installed_at) const
  {
    const std::string where = "parameter 'Bolts/" + name + "/Path'";
    AssertThrow(!paths.empty(),
                InputError("the bolt '" + name + "' has no path",
                           where,
                           "give LINESTRING (...) from its head to its toe"));
    const Geometry    geometry = parse_geometry(as_records(paths), where);
    std::vector<Bolt> result;
    const auto       &curves = geometry.curves();
    for (unsigned int i = 0; i < curves.size(); ++i)
    {
      Bolt one = bolt;
      one.name = curves.size() == 1 ? name : name + " " + std::to_string(i + 1);
      one.installed_at = installed_at;
      for (double *limit : {&one.bond_strength,
                            &one.yield_force,
                            &one.rupture_strain,
                            &one.grouted_length})
        if (*limit == 0.)
          *limit = std::numeric_limits<double>::infinity();
      for (const CurvePiece &piece : curves[i].pieces)
      {
        AssertThrow(piece.kind == CurvePiece::Kind::segment,
                    InputError("the path of the bolt '" + name + "' is curved",
                               where,
                               "give it by LINESTRING (...)"));
        if (one.path.empty())
          one.path.push_back(piece.start);
        one.path.push_back(piece.end);
      }
      result.push_back(one);
    }
    return result;
  }
} // namespace NMM
