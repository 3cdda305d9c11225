# tutorials.pl PAGE: follows a tutorial in the working folder. A block "```LANGUAGE FILE" is a file. A block "```console" has commands behind
# "$ " and, behind each, lines that its output must have in this order: "..." stands for any text, "status N" for its exit status,
# usually 0. Figures are compared, to a hundredth, where the target's compiler is the one that they were taken with, GCC 12.
use strict;
use warnings;
use List::Util qw(max);

my ($page) = @ARGV;
my $same_compiler = `arm-none-eabi-gcc -dumpversion` =~ /^12\./;
my $failures = 0;
sub wrong { print "$page:@_\n"; $failures++ }

# Any text for "...", any number for a number.
my $number = qr/[0-9]+(?:\.[0-9]+)?(?:e[-+]?[0-9]+)?/;
sub pattern {
    my ($line) = @_;
    my @texts;
    for my $text (split /\.\.\./, $line, -1) {
        my @between = map { my $words = quotemeta; $words =~ s/(?:\\ )+/\\s+/g; $words } split /$number/, $text, -1;
        push @texts, join "($number)", @between;
    }
    my $pattern = join '.*', @texts;
    return qr/^\s*$pattern\s*$/;
}

# Whether a printed line says what the page's does. A fit ends some digits later on another processor, whose functions round the last
# place otherwise, and what is rounded up turns over: so figures are within a hundredth. Another compiler's are any.
sub says {
    my ($printed, $line) = @_;
    my @found = $printed =~ pattern($line) or return 0;
    my @expected = map { /$number/g } split /\.\.\./, $line, -1;
    return 1 if !$same_compiler || !@expected;
    for my $i (0 .. $#expected) {
        return 0 if abs($found[$i] - $expected[$i]) > 0.01 * abs $expected[$i];
    }
    return 1;
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
        $next++ while $next < @printed && !says($printed[$next], $line);
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
