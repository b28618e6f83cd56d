#include <nmm/base/exceptions.h>
#include <nmm/mechanics/mass_matrix.h>

#include <linear_algebra/cover_matrix_assembler.h>
#include <mechanics/ghost_terms.h>
#include <mechanics/local_system.h>

namespace NMM
{
  namespace
  {
    /// The integrals of w_i w_j over the domain of a rule, which is the reference cell or a part
    /// of it.
    struct ReferenceMass
    {
      double products[WeightFunctions::max_per_cell]
                     [WeightFunctions::max_per_cell];

      void
      integrate(const unsigned int degree, const dealii::Quadrature<2> &rule)
      {
        const unsigned int n = WeightFunctions::n_per_cell(degree);
        for (unsigned int i = 0; i < n; ++i)
          std::fill_n(products[i], n, 0.);
        double w[WeightFunctions::max_per_cell];
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          WeightFunctions::values(degree, rule.point(q), w);
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < n; ++j)
              products[i][j] += rule.weight(q) * w[i] * w[j];
        }
      }
    };
  } // namespace


  void
  assemble_mass_matrix(const CoverSystem                       &covers,
                       const QuadratureCollection              &quadrature,
                       const dealii::AffineConstraints<double> &constraints,
                       const ElasticityProblem                 &problem,
                       const GhostPenalty                      *ghost_penalty,
                       dealii::TrilinosWrappers::SparseMatrix  &matrix)
  {
    using namespace internal;
    const ManifoldMesh     &mesh              = covers.manifold_mesh();
    const MathematicalMesh &mathematical_mesh = mesh.mathematical_mesh();
    const unsigned int      n      = mathematical_mesh.n_covers_per_cell();
    const unsigned int      degree = mathematical_mesh.degree();
    const auto [first, last]       = covers.locally_owned_elements();
    const std::vector<unsigned int> region_to_material =
      problem.region_to_material(mesh.physical_mesh());

    const auto           pairs = owned_pairs(covers, ghost_penalty);
    CoverMatrixAssembler assembler(covers, constraints);
    for (const auto &[e, f] : pairs)
      assembler.couple({covers_of_pair(covers, e, f).data(), 2 * n});
    dealii::TrilinosWrappers::MPI::Vector rhs;
    assembler.build(matrix, rhs);
    assembler.reset();

    LocalSystem   local;
    ReferenceMass whole, cut;
    bool          has_whole = false;
    for (unsigned int e = first; e < last; ++e)
    {
      const ReferenceMass *mass = &whole;
      if (!mesh.is_whole(e))
      {
        cut.integrate(degree, quadrature.rule(e));
        mass = &cut;
      }
      else if (!has_whole)
      {
        whole.integrate(degree, quadrature.rule(e));
        has_whole = true;
      }
      const double density =
        problem.materials[region_to_material[mesh.region(e)]].density * 2. *
        mathematical_mesh.cell_area(mesh.cell(e));
      local.reset(n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int c = 0; c < 2; ++c)
            local.row(i, c)[unknown_of(j, c)] = density * mass->products[i][j];
      assembler.add(covers.covers(e), local.matrix, local.rhs);
    }
    if (!pairs.empty())
    {
      const GhostTerms ghost_terms(covers, problem);
      for (const auto &pair : pairs)
      {
        local.reset(2 * n);
        ghost_terms.add_mass(pair, local);
        assembler.add({covers_of_pair(covers, pair.first, pair.second).data(),
                       2 * n},
                      local.matrix,
                      local.rhs);
      }
    }
    assembler.compress();
  }


  std::shared_ptr<const dealii::TrilinosWrappers::SparseMatrix>
  make_mass_matrix(const FiniteElasticity     &elasticity,
                   const QuadratureCollection &quadrature,
                   const GhostPenalty         *ghost_penalty)
  {
    const ElasticityProblem &problem = elasticity.elasticity_problem();
    for (const Material &material : problem.materials)
      AssertThrow(material.density > 0.,
                  InputError("The density is " +
                               std::to_string(material.density),
                             "material '" + material.name + "'",
                             "dynamics needs a density above 0"));
    auto matrix = std::make_shared<dealii::TrilinosWrappers::SparseMatrix>();
    assemble_mass_matrix(elasticity.cover_system(),
                         quadrature,
                         elasticity.affine_constraints(),
                         problem,
                         ghost_penalty,
                         *matrix);
    return matrix;
  }
} // namespace NMM
