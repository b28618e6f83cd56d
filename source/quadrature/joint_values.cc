#include <nmm/quadrature/joint_values.h>

#include <algorithm>

namespace NMM
{
  dealii::DynamicSparsityPattern
  make_sparsity_pattern(const CoverSystem                       &covers,
                        const unsigned int                       n_components,
                        const dealii::AffineConstraints<double> &constraints,
                        const std::vector<EdgePiece>            &pieces)
  {
    const dealii::IndexSet relevant =
      covers.locally_relevant_dofs(n_components);
    dealii::DynamicSparsityPattern               pattern(relevant.size(),
                                           relevant.size(),
                                           relevant);
    std::vector<dealii::types::global_dof_index> here, there;
    const auto [first, last] = covers.locally_owned_elements();
    for (unsigned int element = first; element < last; ++element)
    {
      covers.get_dof_indices(element, n_components, here);
      constraints.add_entries_local_to_global(here, pattern, false);
    }
    for (const EdgePiece &piece : pieces)
    {
      covers.get_dof_indices(piece.element, n_components, here);
      covers.get_dof_indices(piece.edge.neighbor, n_components, there);
      here.insert(here.end(), there.begin(), there.end());
      std::sort(here.begin(), here.end());
      here.erase(std::unique(here.begin(), here.end()), here.end());
      constraints.add_entries_local_to_global(here, pattern, false);
    }
    return pattern;
  }


  JointValues::JointValues(const CoverSystem              &covers,
                           const unsigned int              degree,
                           const dealii::FiniteElement<2> &fe,
                           const dealii::UpdateFlags       flags)
    : sides{{EdgeValues(covers, degree, fe, flags),
             EdgeValues(covers, degree, fe, flags)}}
  {
  }


  void
  JointValues::reinit(const EdgePiece &piece)
  {
    Assert(piece.edge.neighbor != invalid_index,
           dealii::ExcMessage("The piece has no element on its other side: "
                              "take pieces of joint_pieces()."));
    sides[0].reinit(piece);
    sides[1].reinit_opposite(piece.edge.neighbor, sides[0]);
    global_indices = sides[0].get_dof_indices();
    interface_to_side.clear();
    for (const unsigned int i : sides[0].dof_indices())
      interface_to_side.push_back({{i, invalid_index}});
    for (const unsigned int i : sides[1].dof_indices())
    {
      const auto index = sides[1].get_dof_indices()[i];
      const auto end   = global_indices.begin() + sides[0].dofs_per_element();
      const auto same  = std::find(global_indices.begin(), end, index);
      if (same != end)
        interface_to_side[same - global_indices.begin()][1] = i;
      else
      {
        global_indices.push_back(index);
        interface_to_side.push_back({{invalid_index, i}});
      }
    }
  }
} // namespace NMM
