#include <nmm/base/exceptions.h>
#include <nmm/quadrature/edge_values.h>

#include "edge_rule.h"

namespace NMM
{
  namespace
  {
    /// The edges of this rank's elements for which is_wanted(element, edge, curve) holds for a
    /// curve on the edge.
    template <typename IsWanted>
    std::vector<EdgePiece>
    collect_pieces(const CoverSystem &covers, const IsWanted &is_wanted)
    {
      const ManifoldMesh              &mesh = covers.manifold_mesh();
      const std::vector<unsigned int> &piece_to_curve =
        mesh.physical_mesh().piece_to_curve();
      std::vector<EdgePiece> result;
      const auto [first, last] = covers.locally_owned_elements();
      for (unsigned int element = first; element < last; ++element)
        for (const ElementEdge &edge : mesh.edges(element))
        {
          if (edge.curve_set == invalid_index)
            continue;
          const std::vector<unsigned int> &set = mesh.curve_set(edge.curve_set);
          for (const unsigned int piece : set)
            if (is_wanted(element, edge, piece_to_curve[piece]))
            {
              result.push_back({element, edge});
              break;
            }
        }
      return result;
    }


    /// Whether each curve is called @p name.
    std::vector<bool>
    curves_called(const CoverSystem &covers, const std::string &name)
    {
      const PhysicalMesh &physical = covers.manifold_mesh().physical_mesh();
      const std::vector<unsigned int> curves = physical.find_curves(name);
      AssertThrow(!curves.empty(),
                  InputError("no curve has this name",
                             "'" + name + "'",
                             "use the name of a curve of the geometry"));
      std::vector<bool> result(physical.curves().size());
      for (const unsigned int curve : curves)
        result[curve] = true;
      return result;
    }
  } // namespace


  std::vector<EdgePiece>
  boundary_pieces(const CoverSystem &covers, const std::string &name)
  {
    const ManifoldMesh     &mesh     = covers.manifold_mesh();
    const std::vector<bool> is_named = curves_called(covers, name);
    return collect_pieces(covers,
                          [&](const unsigned int element,
                              const ElementEdge &,
                              const unsigned int curve) {
                            return is_named[curve] &&
                                   mesh.physical_mesh().is_face_of(
                                     curve, mesh.region(element));
                          });
  }


  std::vector<EdgePiece>
  joint_pieces(const CoverSystem &covers, const std::string &name)
  {
    const std::vector<Curve> &curves =
      covers.manifold_mesh().physical_mesh().curves();
    const std::vector<bool> is_named =
      name.empty() ? std::vector<bool>() : curves_called(covers, name);
    return collect_pieces(covers,
                          [&](const unsigned int element,
                              const ElementEdge &edge,
                              const unsigned int curve) {
                            return edge.neighbor != invalid_index &&
                                   element < edge.neighbor &&
                                   (name.empty()
                                      ? curves[curve].role == CurveRole::joint
                                      : is_named[curve]);
                          });
  }


  EdgeValues::EdgeValues(const CoverSystem              &covers,
                         const unsigned int              degree,
                         const dealii::FiniteElement<2> &fe,
                         const dealii::UpdateFlags       flags)
    : ShapeValues(covers, fe, flags)
    , rule_degree(degree)
  {
  }


  void
  EdgeValues::reinit(const EdgePiece &piece)
  {
    internal::set_edge_rule(piece.edge,
                            cell_frame(covers->manifold_mesh(), piece.element),
                            rule_degree,
                            rule);
    own_table.points = rule.points;
    tabulate(own_table);
    weights = rule.weights;
    ShapeValues::reinit(piece.element, own_table);
  }


  void
  EdgeValues::reinit_opposite(const unsigned int element,
                              const EdgeValues  &other)
  {
    const ManifoldMesh     &mesh  = covers->manifold_mesh();
    const MathematicalMesh &cells = mesh.mathematical_mesh();
    const unsigned int      from  = mesh.cell(other.element()),
                       to         = mesh.cell(element);
    own_table.points              = other.rule.points;
    if (from != to)
      for (dealii::Point<2> &x : own_table.points)
        x = cells.real_to_reference(to, cells.reference_to_real(from, x));
    tabulate(own_table);
    rule.normals = other.rule.normals;
    weights      = other.weights;
    ShapeValues::reinit(element, own_table);
  }
} // namespace NMM
