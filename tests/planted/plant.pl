#!/usr/bin/perl
# plant.pl FILE SYMBOL CHANGE: plants a bug in FILE, as README.md says. plant.pl --check ROOT < LIST: plants none, and names each of
# a list that cannot be planted below ROOT. Exit 1 where a file, a symbol or its tokens are not there, or are more than the bug says.
use strict;
use warnings;

# A file's tokens as [text, begin, end]: no comments, no preprocessor lines, a text in quotes as one.
sub tokens_of {
    my ($code) = @_;
    my @tokens;
    my $line_begins = 1;
    for ($code) {
        while ((pos($_) // 0) < length $_) {
            if (/\G\s+/gc) { $line_begins ||= $& =~ /\n/; next; }
            if ($line_begins && /\G#(?:[^\n\\]|\\\n|\\.)*/gc) { next; }
            if (m{\G(?://[^\n]*|/\*.*?\*/)}sgc) { next; }
            $line_begins = 0;
            my $begin = pos($_) // 0;
            /\G(?:u8|[uUL])?R"([^()\\\s]*)\(.*?\)\1"/sgc || /\G(?:u8|[uUL])?"(?:[^"\\]|\\.)*"/sgc || /\G'(?:[^'\\]|\\.)+'/gc
                || /\G\.?\d(?:[eEpP][+-]|'(?=\w)|[\w.])*/gc || /\G[A-Za-z_]\w*/gc
                || /\G(?:<=>|<<=|>>=|\.\.\.|->\*|::|->|\+\+|--|<<|>>|[-+*\/%&|^<>=!]=|&&|\|\|)/gc || /\G./sgc;
            push @tokens, [$&, $begin, pos($_)];
        }
    }
    return \@tokens;
}

# The place of each bracket's other half.
sub partners {
    my ($tokens) = @_;
    my (@open, %partner);
    for my $i (0 .. $#$tokens) {
        my $token = $tokens->[$i][0];
        if ($token =~ /^[({[]$/) { push @open, $i; }
        elsif ($token =~ /^[)}\]]$/) {
            my $at = pop @open;
            die "its brackets do not match\n" unless defined $at && $tokens->[$at][0] . $token =~ /^(?:\(\)|\{\}|\[\])$/;
            $partner{$at} = $i;
            $partner{$i} = $at;
        }
    }
    die "its brackets do not match\n" if @open;
    return \%partner;
}

# What is defined in namespaces and classes, as [qualified name, first token, last token]: functions, variables, classes and their
# members. A class lies around its members.
package Symbols {
    sub new {
        my ($class, $tokens) = @_;
        my $self = bless {text => [map { $_->[0] } @$tokens], partner => main::partners($tokens), angle => {}, found => []}, $class;
        $self->scope('', 0, scalar @$tokens);
        return $self->{found};
    }

    sub at { my ($self, $i) = @_; return $self->{text}[$i] // ''; }

    # Behind the > of the < at i.
    sub behind_angle {
        my ($self, $i) = @_;
        my ($depth, $first) = (0, $i);
        while (1) {
            my $token = $self->at($i);
            if ($token eq '<') { ++$depth; }
            elsif ($token =~ /^>>?$/) { $depth -= length $token; }
            elsif ($token =~ /^[({[]$/) { $i = $self->{partner}{$i} // return $first + 1; }
            elsif ($token =~ /^(?:;|[)}\]]|)$/) { return $first + 1; }  # it was no bracket
            ++$i;
            if ($depth <= 0) { $self->{angle}{$i - 1} = $first; return $i; }
        }
    }

    sub behind_template {
        my ($self, $i) = @_;
        while ($self->at($i) eq 'template' && $self->at($i + 1) eq '<') {
            $i = $self->behind_angle($i + 1);
            next unless $self->at($i) eq 'requires';
            do {
                ++$i;
                if ($self->at($i) eq '(') { $i = $self->{partner}{$i} + 1; }
                else {
                    ++$i while $self->at($i) =~ /^(?:!|::|\w+)$/ && $self->at($i + 1) =~ /^(?:!|::|\w+|<)$/ && $self->at($i) !~ /^(?:auto|void|static|constexpr)$/ && $self->at($i + 1) ne '<';
                    ++$i;
                    $i = $self->behind_angle($i) if $self->at($i) eq '<';
                }
            } while ($self->at($i) =~ /^(?:&&|\|\|)$/);
        }
        return $i;
    }

    # The name that ends before i, with its classes and their templates' arguments.
    sub name_before {
        my ($self, $i) = @_;
        my $name = '';
        while (--$i >= 0) {
            if (defined(my $angle = $self->{angle}{$i})) {
                $name = join('', @{$self->{text}}[$angle .. $i]) . $name;
                $i = $angle - 1;
            }
            last unless $self->at($i) =~ /^\w+$/;
            $name = $self->at($i) . $name;
            $name = '~' . $name, --$i if $self->at($i - 1) eq '~';
            last unless $self->at($i - 1) eq '::';
            $name = '::' . $name;
            --$i;
        }
        return $name =~ s/^:://r;
    }

    sub scope {
        my ($self, $within, $i, $end) = @_;
        my $of = sub { return $within eq '' ? $_[0] : "${within}::$_[0]" };
        while ($i < $end) {
            my $first = $i;
            if ($self->at($i) =~ /^[;}]$/) { ++$i; next; }
            if ($self->at($i) =~ /^(?:public|private|protected)$/ && $self->at($i + 1) eq ':') { $i += 2; next; }
            $i = $self->behind_template($i);
            if ($self->at($i) =~ /^(?:using|typedef|static_assert)$/) { $i = $self->behind_statement($i); next; }
            my $at = $i;
            ++$at if $self->at($at) =~ /^(?:inline|extern)$/ && $self->at($at + 1) =~ /^(?:namespace|".*)$/;
            if ($self->at($at) =~ /^(?:namespace|".*)$/) {
                my $name = '';
                $name .= $self->at($at) while $self->at(++$at) =~ /^(?:::|\w+)$/;
                if ($self->at($at) eq '{') {
                    $self->scope($name eq '' ? $within : $of->($name), $at + 1, $self->{partner}{$at});
                    $i = $self->{partner}{$at} + 1;
                    next;
                }
                if ($self->at($i) eq 'namespace') { $i = $self->behind_statement($i); next; }
            }
            ++$at while $self->at($at) =~ /^(?:typedef|static|constexpr|const|inline)$/;
            if ($self->at($at) =~ /^(?:class|struct|union|enum)$/) {
                my $kind = $self->at($at);
                ++$at;
                ++$at if $self->at($at) =~ /^(?:class|struct)$/;
                $at = $self->{partner}{$at} + 1 while $self->at($at) eq '[';
                $at = $self->{partner}{$at + 1} + 1 if $self->at($at) eq 'alignas';
                ++$at while $self->at($at) =~ /^\w+$/ && $self->at($at + 1) eq '::' and ++$at;
                my $name = $self->at($at) =~ /^\w+$/ ? $self->at($at++) : '';
                if ($self->at($at) eq '<') {
                    my $angle = $at;
                    $at = $self->behind_angle($at);
                    $name .= join '', @{$self->{text}}[$angle .. $at - 1];
                }
                ++$at if $self->at($at) eq 'final';
                if ($self->at($at) eq ':') { ++$at while $self->at($at) !~ /^[{;]?$/; }
                if ($self->at($at) eq '{') {
                    my $last = $self->{partner}{$at};
                    $self->add($of->($name), $first, $last);
                    $self->scope($of->($name), $at + 1, $last) if $kind ne 'enum';
                    $i = $self->behind_statement($last + 1);
                    next;
                }
            }
            $i = $self->declaration($of, $first, $i);
        }
    }

    sub add { my ($self, $name, $first, $last) = @_; push @{$self->{found}}, [$name, $first, $last] if $name ne ''; }

    sub behind_statement {
        my ($self, $i) = @_;
        while ($self->at($i) !~ /^(?:;|)$/) { $i = $self->at($i) =~ /^[({[]$/ ? $self->{partner}{$i} + 1 : $i + 1; }
        return $i + 1;
    }

    # A function or a variable that begins at i; behind it.
    sub declaration {
        my ($self, $of, $first, $i) = @_;
        my ($name, $function, $initialises) = ('', 0, 0);
        while (1) {
            my $token = $self->at($i);
            return $i + 1 if $token eq '' || $token eq '}';
            if ($token eq 'operator' && !$function) {
                $name = $self->at($i - 1) eq '::' ? $self->name_before($i - 1) . '::operator' : 'operator';
                ++$i;
                if ($self->at($i) eq '(') { $name .= '()'; $i += 2; }
                else { $name .= $self->at($i) =~ /^\w/ ? ' ' . $self->at($i) : $self->at($i), ++$i while $self->at($i) !~ /^(?:\(|)$/; }
                next;
            }
            if ($token eq ';' || ($token eq '=' && !$function)) {
                $name = $self->variable_before($i) if $name eq '';
                $i = $self->behind_statement($i);
                $self->add($of->($name), $first, $i - 1) if $name ne '';
                return $i;
            }
            if ($token eq '(') {
                if ($self->at($i - 1) !~ /^(?:noexcept|decltype|alignas|explicit|requires|__attribute__|GLSUM_\w+)$/) {
                    $name = $self->name_before($i) if $name eq '';
                    $function = 1 if $name ne '';
                }
                $i = $self->{partner}{$i} + 1;
            } elsif ($token eq '[') {
                $i = $self->{partner}{$i} + 1;
            } elsif ($token eq '<' && $self->at($i - 1) =~ /^\w+$/) {
                $i = $self->behind_angle($i);
            } elsif ($token eq ':' && $function) {
                $initialises = 1;
                ++$i;
            } elsif ($token eq '{') {
                my $last = $self->{partner}{$i};
                my $of_a_member = $initialises && $self->at($i - 1) =~ /^(?:\w+|>)$/;
                if ($function && !$of_a_member) { $self->add($of->($name), $first, $last); return $last + 1; }
                $name = $self->variable_before($i) if $name eq '';
                $i = $last + 1;
            } else {
                ++$i;
            }
        }
    }

    sub variable_before {
        my ($self, $i) = @_;
        $i = $self->{partner}{$i - 1} while $self->at($i - 1) eq ']';
        return $self->name_before($i);
    }
}

# Where a pattern's tokens stand from token i of a file on: behind the last of them, or nothing. "..." is what lies between, within
# its brackets and its statement, up to the first place where the rest follows.
sub match_at {
    my ($pattern, $p, $tokens, $i, $last, $partner) = @_;
    for (; $p < @$pattern; ++$p, ++$i) {
        if ($pattern->[$p] eq '...') {
            while ($i <= $last) {
                my $behind = match_at($pattern, $p + 1, $tokens, $i, $last, $partner);
                return $behind if defined $behind;
                my $token = $tokens->[$i][0];
                return undef if $token =~ /^[)}\];]$/;
                $i = $partner->{$i} if $token =~ /^[({[]$/;
                ++$i;
            }
            return undef;
        }
        return undef unless $i <= $last && $tokens->[$i][0] eq $pattern->[$p];
    }
    return $i;
}

# A file as [code, tokens, partners, symbols].
sub parsed {
    my ($code) = @_;
    my $tokens = tokens_of($code);
    return {code => $code, tokens => $tokens, partners => partners($tokens), symbols => Symbols->new($tokens)};
}

# Where the tokens of a pattern stand in a symbol: [first token, behind the last] of each place. All that bear a name are one.
sub places_of {
    my ($file, $symbol, $pattern) = @_;
    my $named = join '(?:<.*>)?::', map { /^(.*\w)<(.*)>$/ ? "\Q$1<$2\E(?:,.*)?>" : "\Q$_\E" } split /::/, $symbol;
    my @extents = grep { $_->[0] =~ /(?:^|::)$named(?:<.*>)?$/ } @{$file->{symbols}};
    die "no $symbol is in it\n" unless @extents;
    my %behind;
    for (@extents) {
        my (undef, $first, $last) = @$_;
        for my $i ($first .. $last) {
            next if $pattern->[0] ne $file->{tokens}[$i][0];
            my $behind = match_at($pattern, 0, $file->{tokens}, $i, $last, $file->{partners});
            $behind{$i} = $behind if defined $behind;
        }
    }
    return map { [$_, $behind{$_}] } sort { $a <=> $b } keys %behind;
}

# The file's code with one change, "OLD => NEW" or "K of N: OLD => NEW".
sub changed {
    my ($file, $symbol, $change) = @_;
    my ($which, $count, $old, $new) = $change =~ /^(?:(\d+|all) of (\d+): )?(.*?) =>(?: (.*))?$/s or die "expected OLD => NEW, found $change\n";
    $new //= '';
    my $code = $file->{code};
    my @spans;
    if ($symbol =~ /^(\d+):(\d+)$/) {
        my ($line, $column) = ($1 - 1, $2 - 1);
        $code =~ /\A(?:[^\n]*\n){$line}[^\n]{$column}(?=\Q$old\E)/ or die "at $symbol is no $old\n";
        @spans = ([$+[0], $+[0] + length $old]);
    } else {
        my @pattern = map { $_->[0] } @{tokens_of($old)};
        die "expected tokens before =>, and no ... before or behind them, found $change\n" if ($pattern[0] // '...') eq '...' || $pattern[-1] eq '...';
        my @found = places_of($file, $symbol, \@pattern);
        die "expected $old @{[defined $count ? \"$count times\" : 'once']} in $symbol, found it @{[scalar @found]} times\n" if @found != ($count // 1);
        if (($which // 1) ne 'all') {
            die "expected a place from 1 to @{[scalar @found]}, found $which\n" unless ($which // 1) >= 1 && ($which // 1) <= @found;
            @found = $found[($which // 1) - 1];
        }
        @spans = map { [$file->{tokens}[$_->[0]][1], $file->{tokens}[$_->[1] - 1][2]] } @found;
    }
    substr($code, $_->[0], $_->[1] - $_->[0], $new) for reverse @spans;
    return $code;
}

# The code with one change after the other.
sub planted {
    my ($code, $symbol, $changes) = @_;
    $code = changed(parsed($code), $symbol, $_) for split / ;; /, $changes;
    return $code;
}

sub content_of {
    my ($path) = @_;
    open my $in, '<', $path or die "it cannot be read\n";
    local $/;
    return scalar <$in>;
}

# Whether each bug of the list can be planted. A file is read once.
sub check {
    my ($root) = @_;
    my ($failed, %seen, %files) = (0);
    while (<STDIN>) {
        chomp;
        next if /^\s*(?:#|$)/;
        my ($name, $path, $symbol, $changes) = map { s/^\s+|\s+$//gr } split /\|/, $_, 4;
        eval {
            die "expected NAME | FILE | SYMBOL | CHANGE, found $_\n" unless defined $changes;
            die "it is there twice\n" if $seen{$name}++;
            $files{$path} //= parsed(content_of("$root/$path"));
            my ($first, @more) = split / ;; /, $changes;
            my $code = changed($files{$path}, $symbol, $first);
            $code = planted($code, $symbol, join ' ;; ', @more) if @more;
            die "it changes nothing\n" if $code eq $files{$path}{code};
            1;
        } or do {
            print "$name: @{[$path // '']}: $@";
            $failed = 1;
        };
    }
    return $failed;
}

unless (caller) {
    exit check($ARGV[1]) if @ARGV == 2 && $ARGV[0] eq '--check';
    die "usage: plant.pl FILE SYMBOL CHANGE, or plant.pl --check ROOT < LIST\n" unless @ARGV == 3;
    my ($path, $symbol, $changes) = @ARGV;
    my $code = eval { planted(content_of($path), $symbol, $changes) } // do { print STDERR $@; exit 1; };
    open my $out, '>', $path or die "$path: $!\n";
    print $out $code;
    close $out or die "$path: $!\n";
}
1;
