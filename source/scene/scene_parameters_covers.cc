#include <nmm/base/exceptions.h>
#include <nmm/scene/scene_parameters_covers.h>

#include <deal.II/base/patterns.h>

#include <algorithm>
#include <scene/parsing.h>

namespace NMM
{
  namespace Patterns = dealii::Patterns;
  using namespace internal;

  namespace
  {
    using Kind = RegionMesh::Kind;

    const Words<Stabilization> stabilizations = {
      {"aggregation", Stabilization::aggregation},
      {"ghost penalty", Stabilization::ghost_penalty},
      {"none", Stabilization::none}};

    const Words<Kind> own_mesh_choices = {{"where needed", Kind::where_needed},
                                          {"every region", Kind::own},
                                          {"never", Kind::main_mesh},
                                          {"automatic", Kind::automatic}};

    const Words<Kind> own_mesh_of_block = {{"where needed", Kind::where_needed},
                                           {"always", Kind::own},
                                           {"never", Kind::main_mesh},
                                           {"automatic", Kind::automatic}};


    bool
    uses_number(const Kind kind)
    {
      return kind == Kind::own || kind == Kind::automatic;
    }
  } // namespace


  void
  BlockMeshParameters::list_entries(Entries &entries)
  {
    std::optional<dealii::Point<2>> point;
    entries.add("Block",
                point,
                "",
                "Covers/" + name,
                "A point inside of the block, x, y [m]. Must be set.");
    entries.add("Own mesh",
                mesh.kind,
                own_mesh_of_block,
                "As 'Own meshes' of all blocks; always: the block has one.");
    entries.add(
      "Elements across",
      mesh.n_across,
      Patterns::Integer(0, 1000),
      "always, automatic: as for all blocks; 0: the number of these.");
    if (!entries.are_parsed())
      return;
    AssertThrow(point,
                InputError("no block is given a mathematical mesh by '" + name +
                             "'",
                           "parameter 'Covers/" + name + "/Block'",
                           "give a point inside of the block"));
    block = *point;
  }


  void
  CoverParameters::list_entries(Entries                        &entries,
                                const std::vector<std::string> &block_names)
  {
    entries.add(
      "Stabilization",
      stabilization,
      stabilizations,
      "What is done about physical covers with little support. aggregation: "
      "they follow the polynomial of the nearest well-supported element of the "
      "same block, so accuracy and conditioning do not depend on how the mesh "
      "is cut; ghost penalty: the difference between the polynomials of such "
      "elements and their neighbours' costs energy; none: the plain method.");
    entries.add(
      "Threshold",
      threshold,
      Patterns::Double(0, 1),
      "An element is well supported if it sees at least this share of the "
      "energy of any linear strain of its cell [-]; 0: all are.");
    entries.add(
      "Own meshes",
      mesh.kind,
      own_mesh_choices,
      "Regions with a mathematical mesh of their own size and shape. where "
      "needed: those smaller or thinner than the cells, none of whose elements "
      "is well supported; every region: each, down to a single six-node "
      "triangle; never: all are on one mesh; automatic: those that the cells "
      "do not resolve by 'Elements across'.");
    entries.add("Elements across",
                mesh.n_across,
                Patterns::Integer(0, 1000),
                "every region, automatic: cells of a region's own mesh along "
                "the longer side of the smallest rectangle around it; 1: a "
                "single six-node triangle. automatic needs it; 0: cells as "
                "large as those of the common mesh.");
    entries.subsections(
      block_names,
      blocks,
      "Names of blocks for which something else is chosen, each with a "
      "subsection of its own.",
      [&](BlockMeshParameters &block, const std::string &name) {
        block.name = name;
        block.list_entries(entries);
        RegionMesh &of_block = block.mesh;
        AssertThrow(
          of_block.n_across == 0 || uses_number(of_block.kind),
          InputError(std::to_string(of_block.n_across) +
                       " elements across would not be used",
                     "parameter 'Covers/" + name + "/Elements across'",
                     "remove it, or set 'Own mesh' to always or automatic"));
        if (of_block.n_across == 0 && uses_number(of_block.kind))
          of_block.n_across = mesh.n_across;
      });
  }


  void
  CoverParameters::check() const
  {
    const auto check_number = [](const RegionMesh  &choice,
                                 const std::string &section) {
      AssertThrow(
        choice.kind != Kind::automatic || choice.n_across > 0,
        InputError(
          "no number of elements across a block is given",
          "parameter '" + section + "/Elements across'",
          "give at least 1, for an automatic choice of the mathematical mesh"));
    };
    check_number(mesh, "Covers");
    for (const BlockMeshParameters &block : blocks)
      check_number(block.mesh, "Covers/" + block.name);
    const bool is_used = uses_number(mesh.kind) ||
                         std::any_of(blocks.begin(),
                                     blocks.end(),
                                     [](const BlockMeshParameters &block) {
                                       return uses_number(block.mesh.kind);
                                     });
    AssertThrow(
      mesh.n_across == 0 || is_used,
      InputError(
        std::to_string(mesh.n_across) + " elements across would not be used",
        "parameter 'Covers/Elements across'",
        "remove it, or set 'Covers/Own meshes' to automatic or every region"));
  }


  bool
  CoverParameters::may_choose_cell_size() const
  {
    const auto chooses = [](const RegionMesh &choice) {
      return choice.kind == Kind::automatic ||
             (choice.kind == Kind::own && choice.n_across > 0);
    };
    return chooses(mesh) && std::all_of(blocks.begin(),
                                        blocks.end(),
                                        [&](const BlockMeshParameters &block) {
                                          return chooses(block.mesh);
                                        });
  }
} // namespace NMM
