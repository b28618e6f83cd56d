#include <nmm/covers/weight_functions.h>
#include <nmm/mechanics/material_vector.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <mechanics/element_near.h>

namespace NMM
{
  namespace
  {
    using Index = dealii::types::global_dof_index;

    /// Derivatives of a vector with respect to both unknowns of a cover, by the cover.
    using Weights = std::map<Index, dealii::Tensor<2, 2>>;


    void
    set_weights(const Weights &weights, MaterialVector &vector)
    {
      vector.unknowns.clear();
      vector.weights.clear();
      for (const auto &[cover, of_cover] : weights)
        for (unsigned int c = 0; c < 2; ++c)
        {
          vector.unknowns.push_back(unknown_of(cover, c));
          vector.weights.push_back(of_cover[c]);
        }
    }


    Weights
    weights_of(const MaterialVector &vector)
    {
      Weights weights;
      for (unsigned int i = 0; i < vector.unknowns.size(); ++i)
        weights[cover_of(vector.unknowns[i])]
               [component_of(vector.unknowns[i])] += vector.weights[i];
      return weights;
    }


    /// The position of a point of an element whose unknowns this rank knows.
    MaterialVector
    position_in_element(const CoverSystem                       &covers,
                        const dealii::AffineConstraints<double> &constraints,
                        const unsigned int                       element,
                        const dealii::Point<2>                  &x)
    {
      const ManifoldMesh     &mesh              = covers.manifold_mesh();
      const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
      double                  values[WeightFunctions::max_per_cell];
      WeightFunctions::values(
        mathematical_mesh.degree(),
        mathematical_mesh.real_to_reference(mesh.cell(element), x),
        values);
      MaterialVector     position;
      Weights            weights;
      std::vector<Index> unknowns;
      position.constant = x;
      position.blocks   = {mesh.block(element)};
      covers.get_dof_indices(element, 2, unknowns);
      for (unsigned int i = 0; i < unknowns.size(); ++i)
      {
        const unsigned int c      = component_of(i);
        const double       weight = values[cover_of(i)];
        const auto         add = [&](const Index unknown, const double value) {
          weights[cover_of(unknown)][component_of(unknown)][c] += value;
        };
        if (!constraints.is_constrained(unknowns[i]))
        {
          add(unknowns[i], weight);
          continue;
        }
        position.constant[c] +=
          weight * constraints.get_inhomogeneity(unknowns[i]);
        for (const auto &entry :
             *constraints.get_constraint_entries(unknowns[i]))
          add(entry.first, weight * entry.second);
      }
      set_weights(weights, position);
      return position;
    }


    std::vector<double>
    pack(const MaterialVector &vector)
    {
      std::vector<double> numbers = {static_cast<double>(vector.blocks[0]),
                                     vector.constant[0],
                                     vector.constant[1]};
      for (unsigned int i = 0; i < vector.unknowns.size(); ++i)
        numbers.insert(numbers.end(),
                       {static_cast<double>(vector.unknowns[i]),
                        vector.weights[i][0],
                        vector.weights[i][1]});
      return numbers;
    }


    MaterialVector
    unpack(const std::vector<double> &numbers)
    {
      MaterialVector vector;
      vector.blocks   = {static_cast<unsigned int>(numbers[0])};
      vector.constant = dealii::Tensor<1, 2>({numbers[1], numbers[2]});
      for (unsigned int i = 3; i < numbers.size(); i += 3)
      {
        vector.unknowns.push_back(static_cast<Index>(numbers[i]));
        vector.weights.push_back(
          dealii::Tensor<1, 2>({numbers[i + 1], numbers[i + 2]}));
      }
      return vector;
    }
  } // namespace


  MaterialVector &
  MaterialVector::operator-=(const MaterialVector &other)
  {
    constant -= other.constant;
    Weights sum = weights_of(*this);
    for (const auto &[cover, of_cover] : weights_of(other))
      sum[cover] -= of_cover;
    set_weights(sum, *this);
    blocks.insert(blocks.end(), other.blocks.begin(), other.blocks.end());
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return *this;
  }


  /// The rank that owns the element knows its unknowns and constraints, and tells all others.
  MaterialVector
  material_point(const CoverSystem                       &covers,
                 const dealii::AffineConstraints<double> &constraints,
                 const dealii::Point<2>                  &x,
                 const std::string                       &what)
  {
    const unsigned int element =
      internal::find_element_near(covers.manifold_mesh(), x, what);
    const auto [first, last] = covers.locally_owned_elements();
    std::vector<double> mine;
    if (element >= first && element < last)
      mine = pack(position_in_element(covers, constraints, element, x));
    const auto of_ranks =
      dealii::Utilities::MPI::all_gather(covers.communicator(), mine);
    const auto owner =
      std::find_if(of_ranks.begin(), of_ranks.end(), [](const auto &numbers) {
        return !numbers.empty();
      });
    Assert(owner != of_ranks.end(), dealii::ExcInternalError());
    return unpack(*owner);
  }


  std::vector<dealii::Tensor<1, 2>>
  evaluate(const std::vector<MaterialVector>           &vectors,
           const dealii::TrilinosWrappers::MPI::Vector &u)
  {
    // a rank may know unknowns of others, which they add themselves
    const dealii::IndexSet owned = u.locally_owned_elements();
    const unsigned int     n     = vectors.size();
    std::vector<double>    sums(2 * n, 0.);
    for (unsigned int v = 0; v < n; ++v)
      for (unsigned int i = 0; i < vectors[v].unknowns.size(); ++i)
        if (const Index unknown = vectors[v].unknowns[i];
            owned.is_element(unknown))
          for (unsigned int c = 0; c < 2; ++c)
            sums[c * n + v] += vectors[v].weights[i][c] * u(unknown);
    dealii::Utilities::MPI::sum(sums, u.get_mpi_communicator(), sums);
    std::vector<dealii::Tensor<1, 2>> values;
    for (unsigned int v = 0; v < n; ++v)
      values.push_back(vectors[v].constant +
                       dealii::Tensor<1, 2>({sums[v], sums[n + v]}));
    return values;
  }
} // namespace NMM
