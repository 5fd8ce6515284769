//! How often long cases keep a checkpoint.

use clap::Args;

/// Where nothing else is asked for.
pub(super) const EVERY_S: f64 = 300.0;

#[derive(Debug, Clone, Copy, Args)]
pub(super) struct KeepArgs {
    /// A long case keeps a checkpoint every so many seconds. After a kill it goes on from there, to the same
    /// bits. 0 keeps none.
    #[arg(long, value_name = "SECONDS", default_value_t = EVERY_S, value_parser = seconds)]
    #[arg(allow_negative_numbers = true)]
    pub(super) checkpoint_every_s: f64,
}

fn seconds(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|value| value.is_finite() && *value >= 0.0);
    value.ok_or_else(|| {
        "must be a finite number of seconds above 0, or 0 for no checkpoints".to_owned()
    })
}
