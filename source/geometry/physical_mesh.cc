#include <nmm/geometry/physical_mesh.h>

#include <CGAL/Arr_batched_point_location.h>

#include "geometry/arrangement.h"
#include "geometry/cgal_compat.h"
#include "geometry/curve.h"
#include "geometry/face_labels.h"
#include "geometry/loops.h"
#include "geometry/outline.h"
#include "geometry/overlaps.h"
#include "geometry/small_blocks.h"
#include "geometry/tiny_faces.h"
#include "geometry/trimming.h"
#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace NMM
{
  struct PhysicalMesh::Data
  {
    std::vector<Curve>            curves;
    std::vector<CurvePiece>       pieces;
    std::vector<unsigned int>     piece_to_curve;
    std::vector<Region>           regions;
    unsigned int                  n_blocks = 0;
    std::vector<std::string>      material_names;
    dealii::BoundingBox<2>        bounding_box;
    std::vector<std::string>      notices;
    DanglingEnds                  dangling_ends;
    std::vector<CleaningAction>   merged_blocks;
    internal::PhysicalArrangement arrangement;
    /// Loop of each curve, see internal::Loops, and loops around each region, see
    /// LabelledFaces::Face::loops.
    std::vector<unsigned int>              curve_to_loop;
    std::vector<std::vector<unsigned int>> region_to_loops;

    void
    take_curves(Geometry &geometry);
    void
    insert_pieces();
    /// Number the solid faces; united faces have one number. Returns the map region_to_face.
    std::vector<unsigned int>
    make_regions(const internal::LabelledFaces &faces,
                 const internal::TinyFaces     &tiny);
    void
    make_blocks(const internal::LabelledFaces &faces);
    void
    assign_loop_materials(const internal::LabelledFaces   &faces,
                          const internal::Loops           &loops,
                          const std::vector<unsigned int> &region_to_face);
    void
    assign_material_points(
      const std::vector<std::pair<dealii::Point<2>, std::string>> &points);
    void
    assign_material_regions(
      const std::vector<Curve>                               &places,
      const std::vector<std::pair<std::string, std::string>> &materials);
    /// Number regions and blocks again, as @p small_blocks has merged them.
    void
    merge_blocks(const internal::SmallBlocks &small_blocks,
                 std::vector<unsigned int>   &region_to_face);
    void
    inspect_lines(const internal::LabelledFaces &faces);
    unsigned int
    material_index(const std::string &name);
  };


  namespace
  {
    /// Lengths [m] of the parts of a joint or interface.
    struct LineUse
    {
      double inside         = 0.;
      double outside        = 0.;
      double along_boundary = 0.;
      double twice          = 0.;
      /// Length inside the solid with different regions on both sides.
      double separating = 0.;
    };

    bool
    is_line(const Curve &curve)
    {
      return curve.role == CurveRole::joint ||
             curve.role == CurveRole::interface;
    }
  } // namespace


  void
  PhysicalMesh::Data::take_curves(Geometry &geometry)
  {
    curves = std::move(geometry.curves());
    for (const Curve &curve : curves)
      curve.check();
    const std::string overlaps =
      internal::unite_overlaps(curves, geometry.unites_doubled_joints());
    if (!overlaps.empty())
      notices.push_back(overlaps);
    bool         has_boundary   = false;
    unsigned int n_straightened = 0, first_straightened = 0;
    std::map<std::string, unsigned int> name_to_curve;
    for (unsigned int c = 0; c < curves.size(); ++c)
    {
      const Curve &curve = curves[c];
      has_boundary       = has_boundary || curve.role == CurveRole::boundary;
      const auto it      = name_to_curve.insert({curve.name, c}).first;
      AssertThrow(curves[it->second].role == curve.role,
                  InputError("the name '" + curve.name + "' belongs to a " +
                               to_string(curves[it->second].role) +
                               " and to a " + to_string(curve.role),
                             internal::describe_place(curve, curve.start()),
                             "rename one; only curves of the same role may "
                             "share a name"));
      for (const CurvePiece &piece : curve.pieces)
      {
        pieces.push_back(piece);
        piece_to_curve.push_back(c);
        if (piece.is_straightened && n_straightened++ == 0)
          first_straightened = pieces.size() - 1;
      }
    }
    if (n_straightened > 0)
    {
      const bool   one   = n_straightened == 1;
      const Curve &curve = curves[piece_to_curve[first_straightened]];
      notices.push_back(
        (one ? "an arc of "
             : std::to_string(n_straightened) + " arcs, the first of ") +
        internal::describe(curve) + " at " +
        internal::describe_place(curve, pieces[first_straightened].start) +
        (one ? ", differs from a segment by less than rounding and is one"
             : ", differ from segments by less than rounding and are such"));
    }
    AssertThrow(has_boundary,
                InputError("the geometry has no outer boundary",
                           curves.empty() || curves[0].source.empty()
                             ? ""
                             : curves[0].source,
                           "add a closed curve of role 'boundary'"));
    Assert(pieces.size() < internal::mesh_edge_flag,
           dealii::ExcInternalError());
  }


  void
  PhysicalMesh::Data::insert_pieces()
  {
    std::vector<internal::Traits::Curve_2> exact;
    exact.reserve(pieces.size());
    for (unsigned int p = 0; p < pieces.size(); ++p)
      exact.emplace_back(internal::exact_curve(pieces[p]), p);
    CGAL::insert(arrangement.arrangement, exact.begin(), exact.end());
  }


  std::vector<unsigned int>
  PhysicalMesh::Data::make_regions(const internal::LabelledFaces &faces,
                                   const internal::TinyFaces     &tiny)
  {
    std::vector<unsigned int> region_to_face;
    for (unsigned int f = 0; f < faces.faces().size(); ++f)
      if (faces.is_solid(f) && tiny.owner(f) == f)
        region_to_face.push_back(f);
    for (const std::string &notice : tiny.notices())
      notices.push_back(notice);
    AssertThrow(!region_to_face.empty(),
                InputError("the whole solid is smaller than coordinates can "
                           "tell apart",
                           internal::describe_place(curves[0],
                                                    curves[0].start()),
                           "move the origin closer to it, or correct its "
                           "coordinates"));

    // Order from left to right, which does not depend on the order of the curves.
    const auto key = [&](const unsigned int f) {
      const auto &face = faces.faces()[f];
      return std::make_tuple(face.corner[0],
                             face.corner[1],
                             face.inside[0],
                             face.inside[1]);
    };
    std::stable_sort(region_to_face.begin(),
                     region_to_face.end(),
                     [&](const unsigned int f, const unsigned int g) {
                       return key(f) < key(g);
                     });

    std::vector<internal::DirectedEdge> outline;
    for (const unsigned int f : region_to_face)
    {
      const auto &face           = faces.faces()[f];
      face.handle->data().region = regions.size();
      regions.push_back({invalid_index,
                         invalid_index,
                         tiny.area(f),
                         face.inside,
                         internal::is_sliver(face)});
      region_to_loops.push_back(face.loops);
      outline.insert(outline.end(), face.boundary.begin(), face.boundary.end());
    }
    for (unsigned int f = 0; f < faces.faces().size(); ++f)
      if (faces.is_solid(f) && tiny.owner(f) != f)
        faces.faces()[f].handle->data().region =
          tiny.owner(f) == invalid_index
            ? invalid_index
            : faces.faces()[tiny.owner(f)].handle->data().region;
    Assert(!outline.empty(), dealii::ExcInternalError());
    bounding_box = internal::bounding_box(outline);
    return region_to_face;
  }


  void
  PhysicalMesh::Data::make_blocks(const internal::LabelledFaces &faces)
  {
    // Union-find with the lowest region as representative.
    std::vector<unsigned int> parent(regions.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](unsigned int r) {
      while (parent[r] != r)
        r = parent[r] = parent[parent[r]];
      return r;
    };
    for (const auto &edge : faces.edges())
    {
      const unsigned int a = edge.halfedge->face()->data().region;
      const unsigned int b = edge.halfedge->twin()->face()->data().region;
      if (a == invalid_index || b == invalid_index ||
          !std::all_of(edge.curves.begin(),
                       edge.curves.end(),
                       [&](const unsigned int c) {
                         return curves[c].role == CurveRole::interface;
                       }))
        continue;
      const auto [low, high] = std::minmax({root(a), root(b)});
      parent[high]           = low;
    }
    for (unsigned int r = 0; r < regions.size(); ++r)
      regions[r].block = root(r) == r ? n_blocks++ : regions[root(r)].block;
  }


  unsigned int
  PhysicalMesh::Data::material_index(const std::string &name)
  {
    const auto it =
      std::find(material_names.begin(), material_names.end(), name);
    if (it != material_names.end())
      return it - material_names.begin();
    material_names.push_back(name);
    return material_names.size() - 1;
  }


  void
  PhysicalMesh::Data::assign_loop_materials(
    const internal::LabelledFaces   &faces,
    const internal::Loops           &loops,
    const std::vector<unsigned int> &region_to_face)
  {
    // Number the materials in the order in which curves name them.
    for (const Curve &curve : curves)
      if (!curve.material.empty())
      {
        AssertThrow(curve.role == CurveRole::boundary ||
                      curve.role == CurveRole::interface,
                    InputError(internal::describe(curve) +
                                 " names the material '" + curve.material + "'",
                               internal::describe_place(curve, curve.start()),
                               "only boundaries, closed interfaces and "
                               "material points have one"));
        material_index(curve.material);
      }

    std::vector<std::vector<unsigned int>> loop_to_faces(loops.loops.size());
    for (unsigned int f = 0; f < faces.faces().size(); ++f)
      for (const unsigned int loop : faces.faces()[f].loops)
        loop_to_faces[loop].push_back(f);
    const auto encloses = [&](const unsigned int outer,
                              const unsigned int inner) {
      return loop_to_faces[outer].size() > loop_to_faces[inner].size() &&
             std::includes(loop_to_faces[outer].begin(),
                           loop_to_faces[outer].end(),
                           loop_to_faces[inner].begin(),
                           loop_to_faces[inner].end());
    };

    for (unsigned int r = 0; r < regions.size(); ++r)
    {
      // Of nested loops the innermost one determines the material, of others the later one.
      unsigned int boundary  = invalid_index;
      unsigned int inclusion = invalid_index;
      for (const unsigned int loop : faces.faces()[region_to_face[r]].loops)
      {
        const auto replace_unless_outside = [&](unsigned int &current) {
          if (current == invalid_index || !encloses(loop, current))
            current = loop;
        };
        if (loops.loops[loop].role == CurveRole::boundary)
          replace_unless_outside(boundary);
        else if (loops.loops[loop].role == CurveRole::interface &&
                 !loops.loops[loop].material.empty())
          replace_unless_outside(inclusion);
      }
      Assert(boundary != invalid_index, dealii::ExcInternalError());
      const std::string &material =
        loops.loops[inclusion != invalid_index ? inclusion : boundary].material;
      if (!material.empty())
        regions[r].material = material_index(material);
    }
  }


  void
  PhysicalMesh::Data::assign_material_regions(
    const std::vector<Curve>                               &places,
    const std::vector<std::pair<std::string, std::string>> &materials)
  {
    for (const auto &[name, material] : materials)
    {
      const auto place = std::find_if(places.begin(),
                                      places.end(),
                                      [name = name](const Curve &curve) {
                                        return curve.name == name;
                                      });
      Assert(place != places.end(), dealii::ExcInternalError());
      bool is_used = false;
      for (Region &region : regions)
        if (internal::contains(*place, region.inside))
        {
          region.material = material_index(material);
          is_used         = true;
        }
      AssertThrow(is_used,
                  InputError("no block has its middle in the region '" + name +
                               "', so that nothing consists of '" + material +
                               "'",
                             internal::describe_place(*place, place->start()),
                             "move or enlarge the region, or let it have no "
                             "material"));
    }
  }


  void
  PhysicalMesh::Data::assign_material_points(
    const std::vector<std::pair<dealii::Point<2>, std::string>> &points)
  {
    using Arrangement = internal::Arrangement;
    using Point       = internal::Traits::Point_2;
    using Location    = CGAL::Arr_point_location_result<Arrangement>::Type;
    const auto less = [](const dealii::Point<2> &a, const dealii::Point<2> &b) {
      return std::make_pair(a[0], a[1]) < std::make_pair(b[0], b[1]);
    };

    // The sweep returns points in its own order. They are found again by their coordinates, which
    // are represented exactly.
    std::vector<Point> exact;
    for (const auto &[point, material] : points)
      exact.emplace_back(internal::Kernel::FT(point[0]),
                         internal::Kernel::FT(point[1]));
    std::vector<std::pair<Point, Location>> located;
    CGAL::locate(arrangement.arrangement,
                 exact.begin(),
                 exact.end(),
                 std::back_inserter(located));
    std::map<dealii::Point<2>, unsigned int, decltype(less)> point_to_region(
      less);
    for (const auto &[point, location] : located)
    {
      const auto *face =
        internal::get_if<Arrangement::Face_const_handle>(location);
      AssertThrow(face != nullptr,
                  InputError("a material point lies on a curve",
                             to_string(internal::to_double(point)),
                             "move it into the region it means"));
      point_to_region[internal::to_double(point)] = (*face)->data().region;
    }

    for (const auto &[point, material] : points)
    {
      const unsigned int region = point_to_region.at(point);
      AssertThrow(region != invalid_index,
                  InputError("the point of material '" + material +
                               "' is outside the solid",
                             to_string(point),
                             "move it into the region it means"));
      regions[region].material = material_index(material);
    }
  }


  void
  PhysicalMesh::Data::merge_blocks(const internal::SmallBlocks &small_blocks,
                                   std::vector<unsigned int>   &region_to_face)
  {
    merged_blocks = small_blocks.actions();
    if (!small_blocks.notice().empty())
      notices.push_back(small_blocks.notice());
    if (merged_blocks.empty())
      return;
    // Regions remain in the order of their leftmost points.
    const std::vector<Region>              old_regions = std::move(regions);
    std::vector<unsigned int>              old_to_new(old_regions.size());
    std::vector<unsigned int>              new_to_face;
    std::vector<std::vector<unsigned int>> new_to_loops;
    std::map<unsigned int, unsigned int>   owner_to_new, block_to_new;
    regions.clear();
    for (unsigned int r = 0; r < old_regions.size(); ++r)
    {
      const unsigned int owner = small_blocks.owner(r);
      const auto [it, is_new]  = owner_to_new.insert({owner, regions.size()});
      old_to_new[r]            = it->second;
      if (is_new)
      {
        regions.push_back(old_regions[owner]);
        regions.back().area = 0.;
        regions.back().block =
          block_to_new.insert({small_blocks.block(r), block_to_new.size()})
            .first->second;
        new_to_face.push_back(region_to_face[owner]);
        new_to_loops.push_back(region_to_loops[owner]);
      }
      Region &region = regions[it->second];
      region.area += old_regions[r].area;
      region.is_sliver = region.is_sliver && old_regions[r].is_sliver;
    }
    n_blocks        = block_to_new.size();
    region_to_face  = std::move(new_to_face);
    region_to_loops = std::move(new_to_loops);
    for (auto f = arrangement.arrangement.faces_begin();
         f != arrangement.arrangement.faces_end();
         ++f)
      if (f->data().region != invalid_index)
        f->data().region = old_to_new[f->data().region];
  }


  void
  PhysicalMesh::Data::inspect_lines(const internal::LabelledFaces &faces)
  {
    std::vector<LineUse>                                    uses(curves.size());
    std::map<std::pair<unsigned int, unsigned int>, double> overlaps;
    for (const auto &edge : faces.edges())
    {
      std::vector<unsigned int> lines;
      bool                      is_on_boundary = false;
      for (const unsigned int c : edge.curves)
        if (is_line(curves[c]))
          lines.push_back(c);
        else
          is_on_boundary = true;
      if (lines.empty())
        continue;

      const double       length = internal::length(faces.geometry(edge));
      const unsigned int n_solid_sides =
        faces.is_solid(edge.left) + faces.is_solid(edge.right);
      for (const unsigned int c : lines)
      {
        LineUse &use = uses[c];
        if (n_solid_sides == 0)
          use.outside += length;
        else if (n_solid_sides == 1)
          use.along_boundary += length;
        else
          use.inside += length;
        if (n_solid_sides == 2 && edge.left != edge.right && !is_on_boundary)
          use.separating += length;
        if (edge.repeated_curve == c)
          use.twice += length;
      }
      if (n_solid_sides == 2)
        for (unsigned int i = 0; i < lines.size(); ++i)
          for (unsigned int j = i + 1; j < lines.size(); ++j)
            overlaps[{lines[i], lines[j]}] += length;
    }

    for (unsigned int c = 0; c < curves.size(); ++c)
    {
      const Curve   &curve = curves[c];
      const LineUse &use   = uses[c];
      if (!is_line(curve))
        continue;
      const std::string name = internal::describe(curve);
      if (curve.is_clipped || (curve.drops_ends && use.inside == 0.))
        continue;
      AssertThrow(use.inside + use.along_boundary > 0.,
                  InputError(name + " is wholly outside the solid",
                             internal::describe_place(curve, curve.start()),
                             "move or remove it"));
      if (use.outside > 0.)
        notices.push_back(name + " reaches outside the solid over " +
                          internal::describe_length(use.outside) +
                          "; that part is ignored");
      if (use.along_boundary > 0.)
        notices.push_back(name + " runs along a boundary over " +
                          internal::describe_length(use.along_boundary) +
                          "; it has no effect there");
      if (use.twice > 0.)
        notices.push_back(name + " runs along itself over " +
                          internal::describe_length(use.twice) +
                          "; that part counts once");
      if (curve.role == CurveRole::interface && use.separating == 0.)
        notices.push_back(name + " separates nothing");
    }
    for (const auto &[pair, length] : overlaps)
      notices.push_back(internal::describe(curves[pair.first]) + " and " +
                        internal::describe(curves[pair.second]) +
                        " coincide over " + internal::describe_length(length));
  }


  PhysicalMesh::PhysicalMesh(Geometry geometry)
    : data(std::make_unique<Data>())
  {
    const auto points = geometry.material_points();
    data->take_curves(geometry);
    const internal::Loops loops = internal::find_loops(data->curves);
    data->curve_to_loop         = loops.curve_to_loop;
    data->insert_pieces();
    internal::Arrangement &arrangement = data->arrangement.arrangement;
    internal::confine_joints(data->curves,
                             data->pieces,
                             data->piece_to_curve,
                             geometry.regions(),
                             arrangement);
    const auto label = [&]() {
      return std::make_unique<internal::LabelledFaces>(
        arrangement, data->curves, data->pieces, data->piece_to_curve, loops);
    };
    auto faces = label();
    data->dangling_ends =
      internal::drop_ends(data->curves, *faces, arrangement);
    if (data->dangling_ends.length_dropped > 0.)
      faces = label();
    const internal::TinyFaces tiny(*faces, data->curves);
    auto                      region_to_face = data->make_regions(*faces, tiny);
    data->make_blocks(*faces);
    data->assign_loop_materials(*faces, loops, region_to_face);
    data->assign_material_regions(geometry.regions(),
                                  geometry.material_regions());
    data->assign_material_points(points);
    data->inspect_lines(*faces);
    const internal::SmallBlocks small_blocks(*faces,
                                             data->curves,
                                             data->regions,
                                             geometry.merging_area(),
                                             geometry.unites_doubled_joints());
    data->merge_blocks(small_blocks, region_to_face);
    std::vector<unsigned int> slivers;
    for (unsigned int r = 0; r < region_to_face.size(); ++r)
      if (data->regions[r].is_sliver)
        slivers.push_back(region_to_face[r]);
    if (!slivers.empty())
      data->notices.push_back(
        internal::describe_slivers(*faces, slivers, data->curves));
    for (unsigned int e = 0; e < faces->edges().size(); ++e)
    {
      const auto &edge = faces->edges()[e];
      if ((faces->is_solid(edge.left) || faces->is_solid(edge.right)) &&
          !small_blocks.vanishes(e))
        data->arrangement.solid_edges.push_back(faces->geometry(edge));
    }
    small_blocks.remove_joints(data->piece_to_curve,
                               data->dangling_ends,
                               arrangement);
    tiny.remove_edges(arrangement);
    if (!data->merged_blocks.empty())
      internal::merge_edges(arrangement);
  }


  PhysicalMesh::~PhysicalMesh()                        = default;
  PhysicalMesh::PhysicalMesh(PhysicalMesh &&) noexcept = default;
  PhysicalMesh &
  PhysicalMesh::operator=(PhysicalMesh &&) noexcept = default;


  const std::vector<Curve> &
  PhysicalMesh::curves() const
  {
    return data->curves;
  }


  const std::vector<CurvePiece> &
  PhysicalMesh::pieces() const
  {
    return data->pieces;
  }


  const std::vector<unsigned int> &
  PhysicalMesh::piece_to_curve() const
  {
    return data->piece_to_curve;
  }


  const std::vector<PhysicalMesh::Region> &
  PhysicalMesh::regions() const
  {
    return data->regions;
  }


  unsigned int
  PhysicalMesh::n_blocks() const
  {
    return data->n_blocks;
  }


  const std::vector<std::string> &
  PhysicalMesh::material_names() const
  {
    return data->material_names;
  }


  const dealii::BoundingBox<2> &
  PhysicalMesh::bounding_box() const
  {
    return data->bounding_box;
  }


  unsigned int
  PhysicalMesh::find_curve(const std::string &name) const
  {
    const std::vector<unsigned int> found = find_curves(name);
    return found.empty() ? invalid_index : found.front();
  }


  std::vector<unsigned int>
  PhysicalMesh::find_curves(const std::string &name) const
  {
    std::vector<unsigned int> found;
    for (unsigned int c = 0; c < data->curves.size(); ++c)
      if (data->curves[c].name == name)
        found.push_back(c);
    return found;
  }


  std::vector<unsigned int>
  PhysicalMesh::blocks_inside(const Curve &border) const
  {
    std::vector<bool> is_inside(n_blocks(), true);
    for (const Region &region : regions())
      if (!internal::contains(border, region.inside))
        is_inside[region.block] = false;
    std::vector<unsigned int> blocks;
    for (unsigned int block = 0; block < n_blocks(); ++block)
      if (is_inside[block])
        blocks.push_back(block);
    return blocks;
  }


  bool
  PhysicalMesh::is_face_of(const unsigned int curve,
                           const unsigned int region) const
  {
    AssertIndexRange(curve, data->curves.size());
    AssertIndexRange(region, data->regions.size());
    const CurveRole role = data->curves[curve].role;
    if (role != CurveRole::boundary && role != CurveRole::hole)
      return true;
    const std::vector<unsigned int> &loops = data->region_to_loops[region];
    const bool is_inside                   = std::binary_search(loops.begin(),
                                              loops.end(),
                                              data->curve_to_loop[curve]);
    return is_inside == (role == CurveRole::boundary);
  }


  const std::vector<std::string> &
  PhysicalMesh::notices() const
  {
    return data->notices;
  }


  const PhysicalMesh::DanglingEnds &
  PhysicalMesh::dangling_ends() const
  {
    return data->dangling_ends;
  }


  const std::vector<CleaningAction> &
  PhysicalMesh::merged_blocks() const
  {
    return data->merged_blocks;
  }


  const internal::PhysicalArrangement &
  PhysicalMesh::arrangement() const
  {
    return data->arrangement;
  }
} // namespace NMM
