//! Macros for models that wrap another model and pass most methods on to it.

/// Implements the methods of [`Cliques`](crate::Cliques) through the field `$model`.
#[macro_export]
macro_rules! delegate_cliques {
    ($model:ident) => {
        fn n_unknowns(&self) -> usize {
            self.$model.n_unknowns()
        }
        fn n_elements(&self) -> usize {
            self.$model.n_elements()
        }
        #[inline(always)]
        fn clique(&self, element: usize) -> &[u32] {
            self.$model.clique(element)
        }
        fn n_primal(&self) -> usize {
            self.$model.n_primal()
        }
    };
}

/// Implements methods of [`Model`](crate::model::Model) over numbers `$T` through the field `$model`. It leaves out `team`, evaluations,
/// products and energies: these methods work on the whole model in every step, and a wrapper defines them.
#[macro_export]
macro_rules! delegate_model {
    ($T:ty, $model:ident) => {
        fn n_extended(&self) -> usize {
            self.$model.n_extended()
        }
        fn n_constraints(&self) -> usize {
            self.$model.n_constraints()
        }
        fn n_memory(&self) -> usize {
            self.$model.n_memory()
        }
        fn has_forces(&self) -> bool {
            self.$model.has_forces()
        }
        fn has_guides(&self) -> bool {
            self.$model.has_guides()
        }
        fn n_signal_states(&self) -> usize {
            self.$model.n_signal_states()
        }
        fn signal_states(&self) -> $crate::model::SignalValues<$T> {
            self.$model.signal_states()
        }
        fn inputs(&self) -> Option<&$crate::inputs::Prescribed<$T>> {
            self.$model.inputs()
        }
        fn terms(&self) -> $crate::model::Terms<$T> {
            self.$model.terms()
        }
        fn write_reference(&self, q: &mut [$T]) {
            self.$model.write_reference(q);
        }
        fn write_sizes(&self, sizes: &mut [$T]) {
            self.$model.write_sizes(sizes);
        }
        fn approaches(&self, q: &[$T], to: &[$T], take: impl FnMut($T)) {
            self.$model.approaches(q, to, take);
        }
        fn set_inputs(
            &self,
            t: $T,
            state: &$crate::model::State<$T>,
            terms: &mut $crate::model::Terms<$T>,
        ) {
            self.$model.set_inputs(t, state, terms);
        }
        fn remember(&self, q: &[$T], terms: &$crate::model::Terms<$T>, memory: &mut [$T]) {
            self.$model.remember(q, terms, memory);
        }
        fn evaluate_phi_t(&self, q: &[$T], terms: &mut $crate::model::Terms<$T>) {
            self.$model.evaluate_phi_t(q, terms);
        }
        fn effective_masses(&self, terms: &$crate::model::Terms<$T>, masses: &mut [$T]) {
            self.$model.effective_masses(terms, masses);
        }
        fn rows(&self, element: usize) -> core::ops::Range<usize> {
            self.$model.rows(element)
        }
        fn write_jacobian(
            &self,
            terms: &$crate::model::Terms<$T>,
            element: usize,
            rows: &mut [$T],
        ) {
            self.$model.write_jacobian(terms, element, rows);
        }
        fn may_be_level(&self, row: usize) -> bool {
            self.$model.may_be_level(row)
        }
        #[inline]
        fn write_block(
            &self,
            terms: &$crate::model::Terms<$T>,
            tangent: &$crate::model::Tangent<'_, $T>,
            element: usize,
            block: &mut [$T],
        ) {
            self.$model.write_block(terms, tangent, element, block);
        }
        fn row_curvature(
            &self,
            q: &[$T],
            terms: &$crate::model::Terms<$T>,
            weights: (&[$T], $T),
            element: usize,
        ) -> $crate::model::RowCurvature<$T> {
            self.$model.row_curvature(q, terms, weights, element)
        }
        #[inline]
        fn has_block(
            &self,
            terms: &$crate::model::Terms<$T>,
            tangent: &$crate::model::Tangent<'_, $T>,
            element: usize,
        ) -> bool {
            self.$model.has_block(terms, tangent, element)
        }
        #[inline]
        fn write_residual(
            &self,
            terms: &$crate::model::Terms<$T>,
            load: &$crate::model::Load<'_, $T>,
            element: usize,
            residual: &mut [$T],
        ) {
            self.$model.write_residual(terms, load, element, residual);
        }
        #[inline]
        fn sum_residuals(
            &self,
            terms: &$crate::model::Terms<$T>,
            load: &$crate::model::Load<'_, $T>,
            f: &mut [$T],
        ) -> bool {
            self.$model.sum_residuals(terms, load, f)
        }
        fn power(&self, q: &[$T], v: &[$T], lambda: &[$T], terms: &$crate::model::Terms<$T>) -> $T {
            self.$model.power(q, v, lambda, terms)
        }
        fn opposite_guide(&self, q: &[$T], terms: &$crate::model::Terms<$T>) -> Option<usize> {
            self.$model.opposite_guide(q, terms)
        }
        fn overturned(&self, terms: &$crate::model::Terms<$T>) -> Option<$crate::model::Owner> {
            self.$model.overturned(terms)
        }
        fn without_direction(
            &self,
            state: &$crate::model::State<$T>,
            dq: &[$T],
        ) -> Option<$crate::step::StepError> {
            self.$model.without_direction(state, dq)
        }
        fn has_velocity_rows(&self) -> bool {
            self.$model.has_velocity_rows()
        }
        fn is_velocity_row(&self, row: usize) -> bool {
            self.$model.is_velocity_row(row)
        }
        fn evaluate_rates(&self, v: &[$T], unit: $T, terms: &mut $crate::model::Terms<$T>) {
            self.$model.evaluate_rates(v, unit, terms);
        }
        fn owner_of_unknown(&self, unknown: usize) -> $crate::model::Owner {
            self.$model.owner_of_unknown(unknown)
        }
        fn owner_of_row(&self, row: usize) -> $crate::model::Owner {
            self.$model.owner_of_row(row)
        }
    };
}
