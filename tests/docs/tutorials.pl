# tutorials.pl PAGE: follows a tutorial in the working folder. A block "```LANGUAGE FILE" is a file. A block "```console" has commands behind
# "$ " and, behind each, lines that its output must have in this order: "..." stands for any text, "status N" for its exit status,
# usually 0. Figures are compared where the target's compiler is the one that they were taken with, GCC 12.
use strict;
use warnings;
use List::Util qw(max);

my ($page) = @ARGV;
my $same_compiler = `arm-none-eabi-gcc -dumpversion` =~ /^12\./;
my $failures = 0;
sub wrong { print "$page:@_\n"; $failures++ }

# Any text for "...", any number for a number of another compiler's.
sub pattern {
    my ($line) = @_;
    my $pattern = join '.*', map { quotemeta } split /\.\.\./, $line, -1;
    $pattern =~ s/[0-9]+(?:\\\.[0-9]+)?(?:e\\?[-+]?[0-9]+)?/[-+0-9.e]+/g unless $same_compiler;
    $pattern =~ s/(?:\\ )+/\\s+/g;
    return qr/^\s*$pattern\s*$/;
}

sub run_one {
    my ($at, $command, @expected) = @_;
    my $status = 0;
    $status = $1 if @expected && $expected[-1] =~ /^status (\d+)$/ && pop @expected;
    my @printed = split /\n/, qx{($command) 2>&1};
    my $found = $? >> 8;
    wrong("$at: $command: expected status $status, found $found:\n@printed[max(0, $#printed - 4) .. $#printed]") if $found != $status;
    my $next = 0;
    for my $line (grep { /\S/ && $_ ne '...' } @expected) {
        my $pattern = pattern($line);
        $next++ while $next < @printed && $printed[$next] !~ $pattern;
        if ($next == @printed) {
            wrong("$at: $command: expected a line '$line', found\n" . join("\n", @printed));
            return;
        }
        $next++;
    }
}

open my $in, '<', $page or die "$page: $!";
my ($language, $file, $text, @block) = ('', '', '');
my $commands = 0;
while (my $line = <$in>) {
    if ($language eq '' && $line =~ /^```(\w+)(?: (\S+))?$/) {
        ($language, $file, $text, @block) = ($1, $2 // '', '');
    } elsif ($language ne '' && $line =~ /^```$/) {
        if ($file ne '') {
            open my $out, '>', $file or die "$file: $!";
            print $out $text;
            close $out;
        }
        run_one(@$_) for @block;
        $commands += @block;
        $language = '';
    } elsif ($language eq 'console' && $line =~ /^\$ (.*)$/) {
        push @block, [$., $1];
    } elsif ($language eq 'console') {
        chomp $line;
        push @{$block[-1]}, $line;
    } elsif ($language ne '') {
        $text .= $line;
    }
}
wrong(" expected commands, found none") unless $commands;
exit($failures ? 1 : 0);
