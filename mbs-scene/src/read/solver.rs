//! Reads the table `[solver]`, by the table of settings of mbs-core.

use crate::read::fields::{Context, Read};
use crate::read::tree::Item;
use mbs_core::scene::{Number, Setting, SettingForm, SettingValue, SolverTable};

/// Reads the settings that are written in the table.
pub(crate) fn read<'a>(context: &Context<'a>, item: &'a Item) -> Read<SolverTable<Number>> {
    let fields = context.table(item, "a table: [solver]", "solver")?;
    let mut table = SolverTable::default();
    for (key, row) in Setting::of_table("solver") {
        let Some(item) = fields.get(key) else { continue };
        let value = match row.form {
            SettingForm::Word(_) => SettingValue::Word(context.text(item)?.to_owned()),
            SettingForm::Descending => {
                let expected = "a list of two numbers: [U, L]";
                SettingValue::Pair(fields.at(key).numbers_of(item, expected)?)
            }
            SettingForm::Flag => SettingValue::Flag(fields.flag(key, false)?),
            SettingForm::Count => SettingValue::Count(fields.count(key, u32::MAX)? as usize),
            SettingForm::Positive => SettingValue::Number(fields.at(key).number(item)?),
        };
        // The value has the form that the table of settings requires, so setting it does not fail.
        let _ = table.set(key, value);
    }
    Ok(table)
}
