#include <nmm/mechanics/error_norms.h>
#include <nmm/quadrature/element_quadrature.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <cmath>

namespace NMM
{
  ErrorNorms
  compute_errors(const DisplacementField &field,
                 const ExactDisplacement &exact_displacement,
                 const ExactStress       &exact_stress,
                 const ElementStress     &stress,
                 const unsigned int       quadrature_degree)
  {
    const CoverSystem         &covers            = field.cover_system();
    const ManifoldMesh        &mesh              = covers.manifold_mesh();
    const MathematicalMesh    &mathematical_mesh = mesh.mathematical_mesh();
    const unsigned int         degree            = quadrature_degree > 0
                                                     ? quadrature_degree
                                                     : 2 * mathematical_mesh.degree() + 4;
    const QuadratureCollection quadrature(mesh,
                                          degree,
                                          degree,
                                          covers.locally_owned_elements());

    // squared norms of the error of u, of u, of the error of sigma, and of sigma
    std::array<double, 4> sums = {{0., 0., 0., 0.}};
    const auto [first, last]   = covers.locally_owned_elements();
    for (unsigned int e = first; e < last; ++e)
    {
      const unsigned int cell = mesh.cell(e);
      const double det = dealii::determinant(mathematical_mesh.jacobian(cell));
      const dealii::Quadrature<2> &rule = quadrature.rule(e);
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const dealii::Point<2> &xi = rule.point(q);
        const dealii::Point<2>  x =
          mathematical_mesh.reference_to_real(cell, xi);
        const double weight = det * rule.weight(q);

        const dealii::Tensor<1, 2>          u     = exact_displacement(x);
        const dealii::SymmetricTensor<2, 2> sigma = exact_stress(x);
        const dealii::SymmetricTensor<2, 2> sigma_h =
          stress ? stress(e, xi) : field.stress(e, xi);
        sums[0] += weight * (field.displacement(e, xi) - u).norm_square();
        sums[1] += weight * u.norm_square();
        sums[2] += weight * (sigma_h - sigma).norm() * (sigma_h - sigma).norm();
        sums[3] += weight * sigma.norm() * sigma.norm();
      }
    }
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(sums.data(), 4),
                                covers.communicator(),
                                dealii::ArrayView<double>(sums.data(), 4));

    ErrorNorms norms;
    norms.displacement_norm = std::sqrt(sums[1]);
    norms.stress_norm       = std::sqrt(sums[3]);
    norms.displacement      = std::sqrt(sums[0]);
    norms.stress            = std::sqrt(sums[2]);
    if (norms.displacement_norm > 0.)
      norms.displacement /= norms.displacement_norm;
    if (norms.stress_norm > 0.)
      norms.stress /= norms.stress_norm;
    return norms;
  }
} // namespace NMM
