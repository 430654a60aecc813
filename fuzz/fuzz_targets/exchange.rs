#![no_main]
libfuzzer_sys::fuzz_target!(|bytes: &[u8]| cross_tests::handled::exchange(bytes));
