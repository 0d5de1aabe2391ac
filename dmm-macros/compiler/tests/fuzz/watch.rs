//! What has to hold of every case, and the clock.

use std::cell::RefCell;
use std::fs;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Once;
use std::time::{Duration, Instant};

use dmm_compiler::diagnostics::catalogue;
use dmm_compiler::{compile, explain};
use proc_macro2::{TokenStream, TokenTree};
use syn::LitStr;

/// The longest that a declaration may take to compile, in processor time of the default profile.
pub(crate) const LONGEST: Duration = Duration::from_secs(2);

/// What became of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// The text is not made of tokens, so that no macro is ever given it.
    NotTokens,
    /// It compiles.
    Accepted,
    /// There are diagnostics.
    Refused,
}

/// What went wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Failure {
    /// The compiler panicked.
    Panic(String),
    /// It took longer than [`LONGEST`].
    Slow(Duration),
    /// What it gave is wrong.
    Wrong(String),
}

impl Failure {
    /// What went wrong, in a line.
    pub(crate) fn message(&self) -> String {
        match self {
            Self::Panic(message) => format!("panic: {message}"),
            Self::Slow(time) => format!("slow: {:.1} s", time.as_secs_f64()),
            Self::Wrong(message) => format!("wrong: {message}"),
        }
    }
}

/// Compiles a case; it and its time, or what went wrong.
pub(crate) fn check(text: &str) -> (Duration, Result<Outcome, Failure>) {
    let Ok(tokens) = text.parse::<TokenStream>() else {
        return (Duration::ZERO, Ok(Outcome::NotTokens));
    };
    let clock = Clock::start();
    let output = guarded(|| compile(tokens.clone()));
    let time = clock.elapsed();
    let outcome = output.and_then(|output| {
        if time > LONGEST {
            return Err(Failure::Slow(time));
        }
        guarded(|| examine(tokens, &output))?
    });
    (time, outcome)
}

/// The output is Rust, says with a code of the catalogue what is wrong with the declaration, and
/// is the same again.
fn examine(tokens: TokenStream, output: &TokenStream) -> Result<Outcome, Failure> {
    let wrong = |message: String| Err(Failure::Wrong(message));
    if let Err(error) = syn::parse2::<syn::File>(output.clone()) {
        return wrong(format!("the output is not Rust: {error}"));
    }
    let errors = compile_errors(output);
    if let Some(message) = uncatalogued(&errors) {
        return wrong(format!("without a code of the catalogue: {message}"));
    }
    let is_internal = |message: &&String| message.starts_with("internal error");
    if let Some(message) = errors.iter().find(is_internal) {
        return wrong(message.clone());
    }
    let text = output.to_string();
    // what compiles takes the longest: one in eight is compiled again
    if errors.is_empty() && !text.len().is_multiple_of(8) {
        return Ok(Outcome::Accepted);
    }
    if compile(tokens.clone()).to_string() != text {
        return wrong("the output is not the same twice".into());
    }
    match explain(tokens) {
        Ok(_) if errors.is_empty() => Ok(Outcome::Accepted),
        Err(messages) if errors == messages => Ok(Outcome::Refused),
        listing => wrong(format!("{errors:?}, but the listing is {listing:?}")),
    }
}

/// The messages of the `compile_error!`s.
fn compile_errors(output: &TokenStream) -> Vec<String> {
    let mut messages = Vec::new();
    let mut is_error = false;
    for token in output.clone() {
        match token {
            TokenTree::Ident(ident) if ident == "compile_error" => is_error = true,
            TokenTree::Group(group) if is_error => {
                is_error = false;
                let text = syn::parse2::<LitStr>(group.stream());
                messages.extend(text.map(|text| text.value()));
            }
            _ => {}
        }
    }
    messages
}

/// A message that does not end with a code of the catalogue.
fn uncatalogued(messages: &[String]) -> Option<&String> {
    let codes = catalogue::all();
    let ends_with_code = |message: &String| {
        codes
            .iter()
            .any(|code| message.ends_with(&format!(" [{code}]")))
    };
    messages.iter().find(|message| !ends_with_code(message))
}

/// Runs `work`; a panic in it is a failure.
fn guarded<T>(work: impl FnOnce() -> T) -> Result<T, Failure> {
    quiet();
    panic::catch_unwind(AssertUnwindSafe(work)).map_err(|_| Failure::Panic(LAST_PANIC.take()))
}

thread_local! {
    /// The message and place of the last panic of this thread.
    static LAST_PANIC: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Panics of cases are kept instead of printed.
fn quiet() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            LAST_PANIC.set(info.to_string().replace('\n', " "));
            if std::thread::current().name() != Some(WORKER) {
                usual(info);
            }
        }));
    });
}

/// The name of the threads that cases run on.
pub(crate) const WORKER: &str = "case";

/// The processor time of this thread where the system tells it, so that a busy machine makes
/// nothing slow; the time on the wall elsewhere.
struct Clock {
    wall: Instant,
    processor: Option<Duration>,
}

impl Clock {
    fn start() -> Self {
        Self {
            wall: Instant::now(),
            processor: processor_time(),
        }
    }

    fn elapsed(&self) -> Duration {
        match (self.processor, processor_time()) {
            (Some(start), Some(end)) => end.saturating_sub(start),
            _ => self.wall.elapsed(),
        }
    }
}

/// The first number of Linux's `schedstat` is the time on a processor in nanoseconds.
fn processor_time() -> Option<Duration> {
    let statistics = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds = statistics.split(' ').next()?.parse().ok()?;
    Some(Duration::from_nanos(nanoseconds))
}
