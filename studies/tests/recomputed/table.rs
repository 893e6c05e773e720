//! The tables of a page.

/// A table with the section that it is in.
pub struct Table {
    /// The section's text before the table.
    pub text: String,
    pub head: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// The number of rounds that the section names first: "medians of 7 rounds".
    pub fn rounds(&self) -> Option<f64> {
        let (before, _) = self.text.split_once(" rounds")?;
        Some(numbers(before).last()?.value)
    }
}

/// All tables of a page.
pub fn tables(page: &str) -> Vec<Table> {
    let (mut text, mut all, mut is_table) = (String::new(), Vec::<Table>::new(), false);
    for line in page.lines() {
        if line.starts_with("## ") {
            text.clear();
        }
        let Some(row) = line.strip_prefix('|') else {
            is_table = false;
            text += line;
            text.push('\n');
            continue;
        };
        let cells = row.strip_suffix('|').unwrap_or(row).split('|').map(|cell| cell.trim().to_owned()).collect();
        match all.last_mut().filter(|_| is_table) {
            None => all.push(Table { text: text.clone(), head: cells, rows: Vec::new() }),
            Some(_) if row.starts_with("---") => {}
            Some(table) => table.rows.push(cells),
        }
        is_table = true;
    }
    all
}

/// A number as it is printed, and by how much rounding may have changed it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    pub value: f64,
    pub rounding: f64,
}

/// The numbers of a text: "1.78 (1.71 to 1.8)", "1,000 of 5e-4".
pub fn numbers(text: &str) -> Vec<Number> {
    let is_part = |c: char| c.is_ascii_digit() || ".,e+-".contains(c);
    text.split(|c: char| !is_part(c)).filter_map(number).collect()
}

fn number(word: &str) -> Option<Number> {
    let word = word.trim_end_matches(['.', ',', '-']).replace(',', "");
    let value: f64 =
        word.parse().ok().filter(|_| word.starts_with(|c: char| c.is_ascii_digit() || "+-".contains(c)))?;
    let (mantissa, power) = word.split_once('e').unwrap_or((&word, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    // Zeros at the end may have been left out.
    let rounding = 0.5 * 10f64.powi(power.parse::<i32>().ok()? - decimals as i32);
    Some(Number { value, rounding: rounding.min(0.005 * value.abs().max(1e-6)) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_pages_write_them() {
        let values = |text: &str| numbers(text).iter().map(|number| number.value).collect::<Vec<_>>();
        assert_eq!(values("1.78 (1.71 to 1.8)"), [1.78, 1.71, 1.8]);
        assert_eq!(values("1,000,007 of 5e-4, -0.3 % and +4.7."), [1_000_007.0, 5e-4, -0.3, 4.7]);
        assert!(values("- | ? ± e, the end").is_empty());
        assert!((numbers("1.78")[0].rounding - 0.005).abs() < 1e-12 && numbers("2.5e-4")[0].rounding <= 5e-6);
    }

    #[test]
    fn tables_have_the_text_of_their_section_and_their_rounds() {
        let page = "# T\n\n## A\n\nOf 3 rounds.\n\n| a | b |\n|---|---|\n| 1 | 2 |\n\nText\n\n| c |\n|---|\n| 3 |\n## B\n| d |\n|---|\n";
        let all = tables(page);
        assert_eq!(all.iter().map(|table| table.rows.len()).collect::<Vec<_>>(), [1, 1, 0]);
        assert_eq!(all.iter().map(Table::rounds).collect::<Vec<_>>(), [Some(3.0), Some(3.0), None]);
        assert_eq!((&*all[0].head[1], &*all[0].rows[0][1]), ("b", "2"));
    }
}
