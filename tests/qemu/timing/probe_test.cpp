int probe_test_placeholder;
