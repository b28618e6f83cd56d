// Assembly of elasticity as a user writes it, with ElementValues; against the library's own.

#include <nmm/quadrature/element_values.h>
#include <nmm/quadrature/joint_values.h>

#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>

#include "staged_model.h"
#include <cmath>
#include <linear_algebra/cover_matrix_assembler.h>

namespace NMM
{
  namespace Bench
  {
    namespace
    {
      /// Call add(local matrix, unknowns, element) for each element.
      template <typename Add>
      void
      assemble(const StagedModel &model, ElementValues &values, const Add &add)
      {
        const PlaneElasticity law =
          model.problem.materials[0].plane_elasticity(PlaneState::plane_strain);
        const dealii::FEValuesExtractors::Vector displacement(0);
        const unsigned int                       n = values.dofs_per_element();
        dealii::FullMatrix<double>               local(n);
        std::vector<SymmetricTensor<2, 2>>       strain(n);
        for (unsigned int e = 0; e < model.manifold_mesh->n_elements(); ++e)
        {
          values.reinit(e);
          local = 0.;
          for (const unsigned int q : values.quadrature_point_indices())
          {
            for (unsigned int i = 0; i < n; ++i)
              strain[i] = values[displacement].symmetric_gradient(i, q);
            for (unsigned int i = 0; i < n; ++i)
            {
              const SymmetricTensor<2, 2> stress =
                values.JxW(q) * (2. * law.mu * strain[i] +
                                 law.lambda * trace(strain[i]) *
                                   dealii::unit_symmetric_tensor<2>());
              for (unsigned int j = 0; j <= i; ++j)
                local(i, j) += stress * strain[j];
            }
          }
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = i + 1; j < n; ++j)
              local(i, j) = local(j, i);
          add(local, values.get_dof_indices(), e);
        }
      }


      enum class Way
      {
        library,
        own_matrix,
        deal_ii_matrix
      };


      /// A square with joints: sparsity pattern and assembly.
      Row
      run(const StagedModel &model, const Way way, Row row)
      {
        row.name       = "weak form";
        row.kinematics = "small";
        row.method     = way == Way::library ? "assemble_at_rest()"
                         : way == Way::own_matrix
                           ? "ElementValues; matrix of covers"
                           : "ElementValues; deal.II's matrix";
        const dealii::FESystem<2> fe(model.mathematical_mesh->fe(), 2);
        const dealii::UpdateFlags flags =
          dealii::update_gradients | dealii::update_JxW_values;
        Stopwatch watch;
        if (way == Way::library)
        {
          FiniteElasticity elasticity(*model.covers,
                                      *model.quadrature,
                                      model.constraints,
                                      model.problem,
                                      /* may_float = */ true);
          row.sparsity = watch.lap();
          elasticity.assemble_at_rest(1.);
          row.assembly = watch.lap();
        }
        else if (way == Way::own_matrix)
        {
          internal::CoverMatrixAssembler         assembler(*model.covers,
                                                   model.constraints);
          dealii::TrilinosWrappers::SparseMatrix matrix;
          Vector                                 rhs;
          assembler.build(matrix, rhs);
          row.sparsity = watch.lap();
          ElementValues values(*model.covers, *model.quadrature, fe, flags);
          const std::vector<double> none_of_them(values.dofs_per_element());
          assembler.reset();
          assemble(model,
                   values,
                   [&](const auto &local, const auto &, const unsigned int e) {
                     assembler.add(model.covers->covers(e),
                                   &local(0, 0),
                                   none_of_them.data());
                   });
          assembler.compress();
          row.assembly = watch.lap();
        }
        else
        {
          dealii::SparsityPattern pattern;
          pattern.copy_from(
            make_sparsity_pattern(*model.covers, 2, model.constraints));
          dealii::SparseMatrix<double> matrix(pattern);
          row.sparsity = watch.lap();
          ElementValues values(*model.covers, *model.quadrature, fe, flags);
          assemble(model,
                   values,
                   [&](const auto &local, const auto &dofs, unsigned int) {
                     model.constraints.distribute_local_to_global(local,
                                                                  dofs,
                                                                  matrix);
                   });
          row.assembly = watch.lap();
        }
        row.total = watch.total();
        return row;
      }
    } // namespace


    void
    measure_values(Recorder &recorder)
    {
      const unsigned int n_joints =
        recorder.size() == Size::smallest ? 2 : 1000;
      GradedMeshParameters mesh;
      mesh.cell_size = std::sqrt(4. / (std::sqrt(3.) * 100. * n_joints));
      mesh.rotation  = 7.;
      Row         row;
      StagedModel model(jointed_square(n_joints),
                        mesh,
                        StagedModel::Options(),
                        row);
      model.problem.plane_state = PlaneState::plane_strain;
      model.problem.materials   = {material("rock", 1e7, 0.2)};
      for (const Way way : {Way::library, Way::own_matrix, Way::deal_ii_matrix})
        recorder.record([&]() { return run(model, way, row); });
    }
  } // namespace Bench
} // namespace NMM
