//! The data of the page against the run it shows.
